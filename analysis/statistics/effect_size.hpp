#pragma once

#include <optional>

#include "shoal/analysis/statistics/differences.hpp"

namespace shoal::analysis::statistics {

// How large a difference is, whatever the number of pairs; beside a p-value, which is not.

/// Cohen's d_z of paired differences: their mean in standard deviations (Cohen 1988, sec. 2.3.5).
/// Nothing where there is no standard error (sample.hpp).
std::optional<double> cohens_d_z(const Differences& differences);

/// d_z without its bias in small samples (the exact factor of Hedges 1981, for n - 1 degrees of
/// freedom). Nothing where there is no d_z, and for n = 2, where no factor removes the bias.
std::optional<double> hedges_g_z(const Differences& differences);

/// The matched-pairs rank-biserial correlation (Kerby 2014): the share of the signed ranks that
/// favours positive differences less the share that favours negative ones, from -1 to 1.
/// Differences of 0 are left out; nothing if there are no others.
std::optional<double> rank_biserial_correlation(const Differences& differences);

}  // namespace shoal::analysis::statistics
