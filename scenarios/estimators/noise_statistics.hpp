#pragma once

#include <algorithm>

#include "shoal/scenarios/estimators/process_noise.hpp"
#include "shoal/scenarios/estimators/sensor_noise.hpp"

namespace shoal::scenarios {

/// The variance for a filter, which takes noise to be white, of noise that is not.
///
/// Rate limits make the noise of a channel smaller than its sigma and correlated in time, so R_n
/// and R_v are measured on the simulated noise itself (131072 samples of fixed streams: they depend
/// on the noise and the period, not on the seed of a trial; what was simulated once is kept).
///
/// A filter that is given the variance of a sample believes the mean of many samples, although they
/// all err the same way: on noise as printed its NEES is about 80 instead of 12. With the long mean
/// it is about 7, and the errors are no larger. The price: a single sample has to be several times
/// further off before it counts as an outlier.
enum class NoiseModel {
  marginal,  ///< white, with the variance of a sample
  white,     ///< white, with the variance whose mean over a long time varies as much
  coloured,  ///< first-order Gauss-Markov, with the variance of a sample and of long means
};

struct ChannelStatistics {
  double variance;     ///< of a sample, about zero
  double white;        ///< NoiseModel::white
  double fault_share;  ///< of all samples

  double of(NoiseModel model) const { return model == NoiseModel::white ? white : variance; }
  /// The correlation from sample to sample of the Gauss-Markov process with both variances, whose
  /// sum over all lags is (1 + phi) / (1 - phi).
  double memory() const { return std::max(0.0, (white - variance) / (white + variance)); }
};

/// Of one channel, with `steps` as step_per_rate() says.
ChannelStatistics simulated_statistics(const GaussMarkov& channel, double steps);

/// R_n of a vehicle's twelve measurements (diagonal but for the mixing, eq. 75). It holds also for
/// noise that is switched off, which a vehicle does not know.
VehicleCovariance simulated_measurement_covariance(const SensorNoise& noise, double period_s,
                                                   NoiseModel model);

/// Correlation of each measurement's noise with its own noise a sample before.
VehicleState simulated_measurement_memory(const SensorNoise& noise, double period_s);

/// The covariance of the disturbing acceleration, (m/s^2)^2 and (rad/s^2)^2.
BodyCovariance simulated_disturbance_covariance(const ProcessNoise& noise, double period_s,
                                                NoiseModel model);

}  // namespace shoal::scenarios
