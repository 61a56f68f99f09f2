#include "shoal/scenarios/estimators/sigma_points.hpp"

#include <cmath>

namespace shoal::scenarios {

void UkfScaling::declare(Options<UkfScaling>& o) {
  o.number("alpha", &UkfScaling::alpha, "", in(1e-4, 10), "spread of the sigma points");
  o.number("beta", &UkfScaling::beta, "", in(0, 100),
           "extra weight of the central point in covariances; 2 suits Gaussian states");
  o.number("kappa", &UkfScaling::kappa, "", in(-1000, 1000),
           "added to the number of states in the spread");
}

SigmaWeights sigma_weights(int states, const UkfScaling& scaling) {
  const double n = states;
  // L + lambda, without the cancellation of Table 2's lambda = alpha^2 (L + kappa) - L.
  const double spread = scaling.alpha * scaling.alpha * (n + scaling.kappa);
  if (!(spread > 0.0) || !std::isfinite(spread)) {
    throw InputError("ukf: alpha^2 (states + kappa) has to be positive, but with alpha = " +
                     std::to_string(scaling.alpha) + ", kappa = " + std::to_string(scaling.kappa) +
                     " and " + std::to_string(states) + " states it is " + std::to_string(spread) +
                     "; take kappa above " + std::to_string(-states));
  }
  const double centre = (spread - n) / spread;
  return {std::sqrt(spread), centre, centre + 1.0 - scaling.alpha * scaling.alpha + scaling.beta,
          0.5 / spread};
}

}  // namespace shoal::scenarios
