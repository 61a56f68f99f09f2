#pragma once

#include <optional>
#include <string>

#include "shoal/core/options.hpp"

namespace shoal::scenarios {

/// How sigma points are drawn and weighted: the scaled unscented transform, van der Merwe 2004.
///
/// With the defaults no weight is negative, whatever the number of states, and covariances stay
/// positive semidefinite. A small alpha gives weights of the order of 1 / alpha^2.
struct UkfScaling {
  double alpha = 1.0;
  double beta = 2.0;
  double kappa = 0.0;

  static void declare(Options<UkfScaling>& o);
};

/// gamma and the weights of Barisic et al. 2011, Table 2, 0.5-0.7, with correction C47.
struct SigmaWeights {
  double gamma;              ///< distance of the points from their centre, in standard deviations
  double mean_centre;        ///< w_m of the central point
  double covariance_centre;  ///< w_c of the central point
  double other;              ///< w_m and w_c of every other point
};

/// Weights for that many states. Throws InputError unless alpha^2 (states + kappa) is positive.
SigmaWeights sigma_weights(int states, const UkfScaling& scaling);

}  // namespace shoal::scenarios
