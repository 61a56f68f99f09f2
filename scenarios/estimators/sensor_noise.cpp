#include "shoal/scenarios/estimators/sensor_noise.hpp"

#include <cmath>
#include <limits>

namespace shoal::scenarios {
namespace {

GaussMarkov model_of(Sensor sensor, bool faults) {
  return faults ? sensor_model(sensor) : sensor_model(sensor).without_faults();
}

}  // namespace

void SensorNoise::declare(Options<SensorNoise>& o) {
  o.flag("on", &SensorNoise::on, "measurements are noisy; otherwise they are the true state");
  o.number("scale", &SensorNoise::scale, "", in(1e-6, 1e3),
           "factor on the noise (Barisic et al. 2011, eqs. 65-75): means, deviations and rates");
  o.flag("faults", &SensorNoise::faults, "channels fail now and then, and then measure nothing");
  o.word("rate_limit", &SensorNoise::rate_limit,
         {{"per_second", RateLimit::per_second}, {"per_sample", RateLimit::per_sample}},
         "whether the noise's rate limits are changes a second or changes a sample");
  o.number("outage_from_s", &SensorNoise::outage_from_s, "s", at_least(0),
           "when all channels of all vehicles fail at once");
  o.number("outage_s", &SensorNoise::outage_s, "s", at_least(0), "for how long (0: they do not)");
}

SensorBanks::SensorBanks(const SensorNoise& noise, std::size_t vehicles,
                         const RandomStreams& random, double period_s)
    : noise_(noise),
      random_(random),
      period_s_(period_s),
      steps_(step_per_rate(noise.rate_limit, period_s)),
      models_{model_of(Sensor::velocity, noise.faults), model_of(Sensor::rate, noise.faults),
              model_of(Sensor::position, noise.faults), model_of(Sensor::depth, noise.faults),
              model_of(Sensor::attitude, noise.faults)},
      banks_(vehicles) {}

bool SensorBanks::out_at(std::uint64_t k) const {
  const double since_s = static_cast<double>(k) * period_s_ - noise_.outage_from_s;
  return since_s >= 0.0 && since_s < noise_.outage_s;
}

VehicleState SensorBanks::sample(std::size_t vehicle, std::uint64_t k) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (out_at(k)) return VehicleState::Constant(nothing);
  if (!noise_.on) return VehicleState::Zero();
  Bank& bank = banks_[vehicle];
  const auto key = static_cast<std::uint32_t>(vehicle);
  VehicleState noise;
  for (std::size_t pair = 0; pair < 6; ++pair) {
    const std::uint64_t index = 6 * k + pair;
    const auto uniform = random_.uniform(Purpose::sensor_state, key, index);
    const auto normal = random_.normal(Purpose::sensor_noise, key, index);
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t i = 2 * pair + half;
      const GaussMarkov& model = models_[static_cast<std::size_t>(sensors[i])];
      noise(static_cast<int>(i)) = model.next(bank[i], uniform[half], normal[half], steps_);
    }
  }
  // A fault is put in after the mixing, or one NaN would make all of them NaN (0 NaN = NaN, C54).
  const auto faulty = noise.array().isNaN().eval();
  VehicleState mixed = sensor_mixing() * faulty.select(VehicleState::Zero(), noise);
  mixed *= noise_.scale;
  return faulty.select(VehicleState::Constant(nothing), mixed);
}

}  // namespace shoal::scenarios
