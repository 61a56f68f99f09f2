#pragma once

#include "shoal/scenarios/estimators/estimator.hpp"
#include "shoal/scenarios/estimators/kinematic_model.hpp"
#include "shoal/scenarios/estimators/noise_statistics.hpp"

namespace shoal::scenarios {

/// The options of the `ukf` estimator.
struct VehicleFilterOptions {
  /// Where the filter's sigma points go. The forces of a vehicle in six degrees of freedom cost
  /// more at 29 points than all the rest of a cycle.
  enum class Propagation {
    kinematic,   ///< as they move; forces are noise
    linearised,  ///< by the linear terms of the vehicle's own model about a centre that it carries
    full,        ///< each by the vehicle's own model
  };

  /// What the Doppler log's velocity is relative to.
  enum class Doppler { bottom_track, water_track };

  /// What the filter takes the water to be: a current of no known direction, whose components vary
  /// along the vehicle's way as Gauss-Markov processes.
  struct Water {
    double sd_m_s = 0.3;
    double time_s = 1800.0;

    static void declare(Options<Water>& o);
  };

  Propagation propagation = Propagation::linearised;
  Doppler doppler = Doppler::water_track;
  Water water;
  UkfScaling scaling;
  double gate_sigma = 4.0;
  std::int64_t gate_patience = 10;
  SensorNoise sensors;
  NoiseModel measurement_noise = NoiseModel::coloured;
  NoiseModel process_noise = NoiseModel::white;
  double model_error_m_s2 = 1e-3;
  double model_error_rad_s2 = 5e-4;

  static void declare(Options<VehicleFilterOptions>& o);

  /// R_v over a period: of the disturbance as simulated and of what the model does not know, as
  /// accelerations that last for the period.
  VehicleCovariance process_covariance(const ProcessNoise& disturbance, double period_s) const;
  UkfSettings<14, 12> settings(const ProcessNoise& disturbance, double period_s) const;
};

/// The filter of one vehicle: twelve states, all of which are measured, and the water's velocity,
/// which is not. Where its deviation is 0 the water is taken to be still.
class VehicleFilter {
 public:
  /// The first estimate is `start` in still water, known as well as one measurement tells.
  VehicleFilter(const VehicleFilterOptions& options, const UkfSettings<14, 12>& settings,
                const VehicleState& start, double period_s);

  /// Carries the estimate over a period; `process` is any callable VehicleBelief -> VehicleBelief.
  template <class Process>
  void predict(const Process& process) {
    const auto fading = [&](const VehicleBelief& x) -> VehicleBelief {
      VehicleBelief carried = process(x);
      carried.tail<2>() *= kept_;
      return carried;
    };
    predicted_ = ukf_.predict(fading, measured_);
  }

  /// What instruments without noise would show.
  VehicleState measured(const VehicleState& x, const Eigen::Vector2d& water) const {
    return measured_(x, water);
  }

  /// Takes the measurements at the end of it, NaN where there are none; `truth` and `water` are for
  /// NEES only.
  ///
  /// A filter that is lost (something was not finite) starts again from what was measured, and
  /// from its last estimate where nothing was, with the covariance it began with.
  const Estimate& correct(const VehicleState& measured, const VehicleState& truth,
                          const Eigen::Vector2d& water);

  const VehicleBelief& belief() const { return ukf_.state(); }

 private:
  struct Measured {
    bool over_ground;

    VehicleState operator()(const VehicleState& x, const Eigen::Vector2d& water) const {
      VehicleState shown = x;
      if (over_ground) shown.head<3>() += KinematicModel::in_body(x.tail<3>(), water);
      return shown;
    }
    VehicleState operator()(const VehicleBelief& x) const {
      return (*this)(VehicleState(x.head<12>()), x.tail<2>());
    }
  };

  BeliefCovariance first_covariance() const;

  Measured measured_;
  double water_sd_m_s_, kept_;
  Ukf<14, 12> ukf_;
  UkfStatus predicted_ = UkfStatus::ok;
  Estimate estimate_;
};

}  // namespace shoal::scenarios
