#pragma once

#include "shoal/analysis/statistics/sample.hpp"

namespace shoal::analysis::statistics {

/// What a table says of a sample, in its unit. NaN is what there is not: sd for n < 2, and
/// everything for n = 0.
struct Summary {
  int n = 0;
  double mean = 0.0;
  double sd = 0.0;  ///< the sample's, with n - 1
  double median = 0.0;
  double q1 = 0.0, q3 = 0.0;  ///< quartiles
  double least = 0.0, greatest = 0.0;
};

Summary summarise(Sample values);

/// The p-quantile: linear between the order statistics, of which the first is the 0- and the last
/// the 1-quantile (type 7 of Hyndman and Fan 1996; the default of R and NumPy). NaN
/// for n = 0. Throws std::invalid_argument unless p lies in [0, 1].
double quantile(Sample values, double p);

}  // namespace shoal::analysis::statistics
