#pragma once

#include <optional>

#include "shoal/analysis/statistics/sample.hpp"

namespace shoal::analysis::statistics {

// Whether one number, a mean, says what a sample is like. Chances are shares of 1999 simulated
// samples of the same size, always the same ones.

/// Hartigan's dip: the least distance (greatest difference) between the sample's distribution
/// function and one with a single mode (Hartigan and Hartigan 1985). At least 1 / (2n). Ties look
/// like modes: nothing where two values are the same, and without values.
std::optional<double> dip(Sample values);
/// The chance of so large a dip in a uniform sample, of all with one mode the one that dips the
/// most. Nothing without a dip, and below 4 values.
std::optional<double> dip_p_value(Sample values);

/// The third standardised moment (g1); 0 for a symmetric sample. Nothing where the values are all
/// the same (sample.hpp), and below 3 values.
std::optional<double> skewness(Sample values);
/// The chance of so large a skewness, of either sign, in a normal sample.
std::optional<double> skewness_p_value(Sample values);

/// The two groups, each side of a number, into which a sample falls best: those with the least
/// squares about their means (2-means, exactly).
struct TwoGroups {
  int low_n = 0, high_n = 0;
  double low_mean = 0.0, high_mean = 0.0;
  double explained = 0.0;  ///< the share of all squares that is between the groups; 0.64 of normal
                           ///< and 0.75 of uniform ones
};
/// Nothing where the values are all the same (sample.hpp).
std::optional<TwoGroups> two_groups(Sample values);

}  // namespace shoal::analysis::statistics
