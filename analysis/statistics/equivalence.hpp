#pragma once

#include <optional>

#include "shoal/analysis/statistics/differences.hpp"

namespace shoal::analysis::statistics {

/// The p-value of two one-sided t tests (TOST; Schuirmann 1987): small if the mean of the paired
/// differences lies within +-`margin` (their unit, above 0) for all that is known. It is below
/// alpha just when the t interval of level 1 - 2 alpha lies within the margin.
///
/// That a test finds no difference does not show that there is none; this does. Nothing where there
/// is no standard error (sample.hpp). Throws std::invalid_argument unless the margin is above 0.
std::optional<double> equivalence_p_value(const Differences& differences, double margin);

}  // namespace shoal::analysis::statistics
