#include "shoal/scenarios/estimators/noise_statistics.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace shoal::scenarios {
namespace {

// Batches outlast the longest memory of a channel, about 200 samples; with this many of them a
// variance is known to an eighth.
constexpr std::uint64_t batches = 128;
constexpr std::uint64_t batch = 1024;

const RandomStreams& own_streams() {
  static const RandomStreams streams(0);
  return streams;
}

/// What has been simulated once, for all later trials of a process. Threads may ask at once.
template <class Key, class Value>
class Simulated {
 public:
  template <class Simulate>
  Value operator()(const Key& key, const Simulate& simulate) {
    const std::scoped_lock lock(mutex_);
    const auto found = known_.find(key);
    return found != known_.end() ? found->second : known_.emplace(key, simulate()).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, Value> known_;
};

ChannelStatistics sensor_statistics(Sensor sensor, bool faults, double steps) {
  static Simulated<std::tuple<Sensor, bool, double>, ChannelStatistics> simulated;
  return simulated({sensor, faults, steps}, [&] {
    const GaussMarkov& printed = sensor_model(sensor);
    return simulated_statistics(faults ? printed : printed.without_faults(), steps);
  });
}

struct DisturbanceStatistics {
  BodyCovariance marginal, white;
};

/// At scale 1.
DisturbanceStatistics simulate_disturbances(RateLimit rate_limit, double period_s) {
  Disturbances disturbances({.scale = 1.0, .rate_limit = rate_limit}, 1, own_streams(), period_s);
  BodyCovariance squares = BodyCovariance::Zero(), squared_means = BodyCovariance::Zero();
  for (std::uint64_t b = 0; b <= batches; ++b) {
    BodyAcceleration sum = BodyAcceleration::Zero();
    BodyCovariance sum_of_squares = BodyCovariance::Zero();
    for (std::uint64_t k = b * batch; k < (b + 1) * batch; ++k) {
      const BodyAcceleration a = disturbances.sample(0, k);
      sum += a;
      sum_of_squares += a * a.transpose();
    }
    if (b == 0) continue;
    squares += sum_of_squares;
    squared_means += sum * sum.transpose() / static_cast<double>(batch);
  }
  return {squares / double{batches * batch}, squared_means / double{batches}};
}

}  // namespace

ChannelStatistics simulated_statistics(const GaussMarkov& model, double steps) {
  GaussMarkov::Channel channel;
  double squares = 0.0, squared_means = 0.0;
  std::uint64_t valid = 0;
  for (std::uint64_t b = 0; b <= batches; ++b) {
    double sum = 0.0, sum_of_squares = 0.0;
    std::uint64_t count = 0;
    for (std::uint64_t k = b * batch; k < (b + 1) * batch; k += 2) {
      const auto uniform = own_streams().uniform(Purpose::sensor_state, 0, k);
      const auto normal = own_streams().normal(Purpose::sensor_noise, 0, k);
      for (std::size_t half = 0; half < 2; ++half) {
        const double y = model.next(channel, uniform[half], normal[half], steps);
        if (std::isnan(y)) continue;
        sum += y;
        sum_of_squares += y * y;
        ++count;
      }
    }
    if (b == 0) continue;  // until the noise is stationary
    valid += count;
    squares += sum_of_squares;
    // The mean of the noise is zero by its symmetry, and not estimated.
    if (count > 0) squared_means += sum * sum / static_cast<double>(count);
  }
  const auto all = static_cast<double>(batches * batch);
  return {squares / static_cast<double>(valid), squared_means / static_cast<double>(batches),
          1.0 - static_cast<double>(valid) / all};
}

VehicleCovariance simulated_measurement_covariance(const SensorNoise& noise, double period_s,
                                                   NoiseModel model) {
  const double steps = step_per_rate(noise.rate_limit, period_s);
  std::array<double, 5> variances{};
  for (const Sensor sensor :
       {Sensor::velocity, Sensor::rate, Sensor::position, Sensor::depth, Sensor::attitude}) {
    variances[static_cast<std::size_t>(sensor)] =
        sensor_statistics(sensor, noise.faults, steps).of(model);
  }
  VehicleState variance;
  for (std::size_t i = 0; i < 12; ++i) {
    variance(static_cast<int>(i)) =
        noise.scale * noise.scale * variances[static_cast<std::size_t>(sensors[i])];
  }
  const VehicleCovariance& S = sensor_mixing();
  const VehicleCovariance R = S * variance.asDiagonal() * S.transpose();
  return 0.5 * (R + R.transpose());
}

VehicleState simulated_measurement_memory(const SensorNoise& noise, double period_s) {
  const double steps = step_per_rate(noise.rate_limit, period_s);
  VehicleState memory;
  for (std::size_t i = 0; i < 12; ++i) {
    memory(static_cast<int>(i)) = sensor_statistics(sensors[i], noise.faults, steps).memory();
  }
  return memory;
}

BodyCovariance simulated_disturbance_covariance(const ProcessNoise& noise, double period_s,
                                                NoiseModel model) {
  static Simulated<std::pair<RateLimit, double>, DisturbanceStatistics> simulated;
  const DisturbanceStatistics found = simulated({noise.rate_limit, period_s}, [&] {
    return simulate_disturbances(noise.rate_limit, period_s);
  });
  return noise.scale * noise.scale * (model == NoiseModel::white ? found.white : found.marginal);
}

}  // namespace shoal::scenarios
