#pragma once

#include "shoal/scenarios/estimators/estimator.hpp"
#include "shoal/scenarios/estimators/kinematic_model.hpp"
#include "shoal/scenarios/estimators/noise_statistics.hpp"

namespace shoal::scenarios {

/// The options of the `ukf` estimator.
struct VehicleFilterOptions {
  /// Where the filter's sigma points go. The forces of a vehicle in six degrees of freedom cost
  /// more at 25 points than all the rest of a cycle.
  enum class Propagation {
    kinematic,  ///< as they move; forces are noise
    recentred,  ///< the same about a centre that the vehicle's own model carries on
    full,       ///< each by the vehicle's own model
  };

  Propagation propagation = Propagation::recentred;
  UkfScaling scaling;
  double gate_sigma = 4.0;
  std::int64_t gate_patience = 10;
  SensorNoise sensors;
  NoiseModel measurement_noise = NoiseModel::white;
  NoiseModel process_noise = NoiseModel::white;
  double model_error_m_s2 = 0.02;
  double model_error_rad_s2 = 0.005;

  static void declare(Options<VehicleFilterOptions>& o);

  /// R_v over a period: of the disturbance as simulated and of what the model does not know, as
  /// accelerations that last for the period.
  VehicleCovariance process_covariance(const ProcessNoise& disturbance, double period_s) const;
  VehicleCovariance measurement_covariance(double period_s) const {
    return simulated_measurement_covariance(sensors, period_s, measurement_noise);
  }
};

/// The filter of one vehicle: 12 states, all of which are measured (H = identity).
class VehicleFilter {
 public:
  /// The first estimate is `start`, known as well as one measurement tells.
  VehicleFilter(const UkfSettings<12, 12>& settings, const VehicleState& start)
      : ukf_(settings, start, first_covariance(settings)) {}

  /// Carries the estimate over a period; `process` is any callable VehicleState -> VehicleState.
  template <class Process>
  void predict(const Process& process) {
    predicted_ = ukf_.predict(process);
  }

  /// Takes the measurements at the end of it, NaN where there are none; `truth` is for NEES only.
  ///
  /// A filter that is lost (something was not finite) starts again from what was measured, and
  /// from its last estimate where nothing was, with the covariance it began with.
  const Estimate& correct(const VehicleState& measured, const VehicleState& truth);

  const Ukf<12, 12>& ukf() const { return ukf_; }

 private:
  static VehicleCovariance first_covariance(const UkfSettings<12, 12>& settings) {
    return settings.measurement_covariance.diagonal().asDiagonal();
  }

  Ukf<12, 12> ukf_;
  UkfStatus predicted_ = UkfStatus::ok;
  Estimate estimate_;
};

}  // namespace shoal::scenarios
