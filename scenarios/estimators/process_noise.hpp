#pragma once

#include <cstdint>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/core/random.hpp"
#include "shoal/scenarios/estimators/gauss_markov.hpp"

namespace shoal::scenarios {

/// Linear (m/s^2) and angular (rad/s^2) acceleration in body axes.
using BodyAcceleration = Eigen::Matrix<double, 6, 1>;
using BodyCovariance = Eigen::Matrix<double, 6, 6>;

/// Covariance and largest rates of the disturbance: Barisic et al. 2011, eqs. 79 and 80. The
/// printed covariance is neither symmetric nor positive semidefinite; it is taken with C55.
const BodyCovariance& disturbance_covariance();
const BodyAcceleration& disturbance_rates();

/// What disturbs a vehicle's motion, as an acceleration added to its own. The chapter gives no
/// units; at scale 1 the disturbance outgrows what the propeller can give.
struct ProcessNoise {
  bool on = true;
  double scale = 0.1;
  RateLimit rate_limit = RateLimit::per_second;

  static void declare(Options<ProcessNoise>& o);
};

/// The disturbances of a swarm: rate-limited correlated normal numbers.
///
/// The k-th sample of a vehicle depends on the seed, the vehicle and k only. Different vehicles may
/// be sampled in parallel.
class Disturbances {
 public:
  Disturbances(const ProcessNoise& noise, std::size_t vehicles, const RandomStreams& random,
               double period_s);

  /// Acceleration from sample `k` = 0, 1, ... (asked for in that order) to the next. All zero while
  /// the noise is off.
  BodyAcceleration sample(std::size_t vehicle, std::uint64_t k);

 private:
  ProcessNoise noise_;
  RandomStreams random_;
  BodyAcceleration steps_;
  BodyCovariance root_;
  std::vector<BodyAcceleration> values_;
};

}  // namespace shoal::scenarios
