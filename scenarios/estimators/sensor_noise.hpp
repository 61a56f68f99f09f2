#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/core/random.hpp"
#include "shoal/scenarios/estimators/gauss_markov.hpp"
#include "shoal/scenarios/estimators/vehicle_state.hpp"

namespace shoal::scenarios {

/// The kinds of channels a vehicle measures, and which of the twelve each is.
enum class Sensor { velocity, rate, position, depth, attitude };
constexpr std::array<Sensor, 12> sensors{Sensor::velocity, Sensor::velocity, Sensor::velocity,
                                         Sensor::rate,     Sensor::rate,     Sensor::rate,
                                         Sensor::position, Sensor::position, Sensor::depth,
                                         Sensor::attitude, Sensor::attitude, Sensor::attitude};

/// The noise of one kind of channel: Barisic et al. 2011, eqs. 65-74.
const GaussMarkov& sensor_model(Sensor sensor);

/// How channels leak into one another: eq. 75, with the exchanged tails of the rows of z and phi
/// put back so that it is symmetric (C54).
const VehicleCovariance& sensor_mixing();

/// The noise of a vehicle's twelve measurements: DVL, rate gyros, USBL, pressure gauge, AHRS.
struct SensorNoise {
  bool on = true;
  double scale = 1.0;
  bool faults = true;
  RateLimit rate_limit = RateLimit::per_second;
  double outage_from_s = 0.0;
  double outage_s = 0.0;

  static void declare(Options<SensorNoise>& o);
};

/// The instruments of a swarm, one bank of twelve channels for each vehicle.
///
/// The k-th sample of a vehicle depends on the seed, the vehicle and k only. Different vehicles may
/// be sampled in parallel.
class SensorBanks {
 public:
  SensorBanks(const SensorNoise& noise, std::size_t vehicles, const RandomStreams& random,
              double period_s);

  /// What is added to the true state in sample `k` = 0, 1, ..., asked for in that order. NaN in the
  /// channels at fault. All zero while the noise is off and there is no outage.
  VehicleState sample(std::size_t vehicle, std::uint64_t k);

  const SensorNoise& noise() const { return noise_; }

 private:
  using Bank = std::array<GaussMarkov::Channel, 12>;

  bool out_at(std::uint64_t k) const;

  SensorNoise noise_;
  RandomStreams random_;
  double period_s_, steps_;
  std::array<GaussMarkov, 5> models_;  // by Sensor
  std::vector<Bank> banks_;
};

}  // namespace shoal::scenarios
