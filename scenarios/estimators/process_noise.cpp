#include "shoal/scenarios/estimators/process_noise.hpp"

#include <numbers>

#include "shoal/scenarios/estimators/covariance.hpp"

namespace shoal::scenarios {

const BodyCovariance& disturbance_covariance() {
  // C55: (w, q) is .003 from both sides, (v, r) .0035, (v, p) and (w, p) .001; as printed these
  // correlations exceed 1, or together leave a negative eigenvalue.
  // clang-format off
  static const BodyCovariance R{
      {0.2,   0.01,   0.01,   0,       0.005,  0.005},
      {0.01,  0.1,    0.0275, 0.001,   0.003,  0.0035},
      {0.01,  0.0275, 0.1,    0.001,   0.003,  0},
      {0,     0.001,  0.001,  0.0011,  0.0001, 0.00015},
      {0.005, 0.003,  0.003,  0.0001,  0.002,  0},
      {0.005, 0.0035, 0,      0.00015, 0,      0.0022}};
  // clang-format on
  return R;
}

const BodyAcceleration& disturbance_rates() {
  constexpr double angular = std::numbers::pi / 36;
  static const BodyAcceleration n{{0.2, 0.2, 0.2, angular, angular, angular}};
  return n;
}

void ProcessNoise::declare(Options<ProcessNoise>& o) {
  o.flag("on", &ProcessNoise::on, "vehicles are disturbed");
  o.number("scale", &ProcessNoise::scale, "", in(1e-6, 1e3),
           "factor on the disturbance (Barisic et al. 2011, eqs. 79-80), taken as acceleration in "
           "m/s^2 and rad/s^2");
  o.word("rate_limit", &ProcessNoise::rate_limit,
         {{"per_second", RateLimit::per_second}, {"per_sample", RateLimit::per_sample}},
         "whether the disturbance's rate limits are changes a second or changes a sample");
}

Disturbances::Disturbances(const ProcessNoise& noise, std::size_t vehicles,
                           const RandomStreams& random, double period_s)
    : noise_(noise),
      random_(random),
      steps_(disturbance_rates() * step_per_rate(noise.rate_limit, period_s)),
      values_(vehicles, BodyAcceleration::Zero()) {
  require_covariance<6>(disturbance_covariance(), "the covariance of the disturbance");
  lower_root<6>(disturbance_covariance(), root_);
}

BodyAcceleration Disturbances::sample(std::size_t vehicle, std::uint64_t k) {
  if (!noise_.on) return BodyAcceleration::Zero();
  BodyAcceleration normals;
  for (Eigen::Index pair = 0; pair < 3; ++pair) {
    const auto [a, b] = random_.normal(Purpose::process_noise, static_cast<std::uint32_t>(vehicle),
                                       3 * k + static_cast<std::uint64_t>(pair));
    normals(2 * pair) = a;
    normals(2 * pair + 1) = b;
  }
  const BodyAcceleration wanted = root_ * normals;
  BodyAcceleration& value = values_[vehicle];
  for (int i = 0; i < 6; ++i) value(i) = rate_limited(value(i), wanted(i), steps_(i));
  return noise_.scale * value;
}

}  // namespace shoal::scenarios
