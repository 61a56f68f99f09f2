#pragma once

#include <bitset>
#include <concepts>
#include <cstdint>
#include <memory>
#include <vector>

#include "shoal/core/random.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/scenarios/estimators/kinematic_model.hpp"
#include "shoal/scenarios/estimators/process_noise.hpp"
#include "shoal/scenarios/estimators/ukf.hpp"
#include "shoal/scenarios/estimators/vehicle_state.hpp"

namespace shoal::scenarios {

/// What a vehicle believes after a sample, and how it came to.
struct Estimate {
  VehicleState state;
  VehicleState sd = VehicleState::Zero();              ///< standard deviations, as believed
  Eigen::Vector2d water = Eigen::Vector2d::Zero();     ///< its velocity, north and east, m/s
  Eigen::Vector2d water_sd = Eigen::Vector2d::Zero();  ///< 0 where the water is not estimated
  VehicleState measured;                               ///< NaN in channels at fault
  VehicleState innovation = VehicleState::Zero();      ///< NaN in channels at fault
  double nis = 0.0;    ///< innovation squared and normalised; chi-squared with `used` degrees
  double nees = 0.0;   ///< error squared and normalised; chi-squared with `estimated` degrees. NaN
                       ///< where the believed covariance has no inverse
  int estimated = 12;  ///< states: 14 with the water's velocity
  int used = 12;       ///< measurements that were used
  std::bitset<12> faulty, rejected, readmitted;
  UkfStatus status = UkfStatus::ok;
};

/// Refers to a vehicle's own model while it is passed on: a callable (VehicleState, velocity of the
/// water) -> VehicleState over a period, with a tangent(VehicleState) -> BodyTangent. The water's
/// velocity is north and east, m/s.
class ProcessRef {
 public:
  template <class Model>
  requires(!std::same_as<Model, ProcessRef>)
      ProcessRef(const Model& model)  // NOLINT: a model is passed as it is
      : model_(&model),
        call_([](const void* any, const VehicleState& x,
                 const Eigen::Vector2d& water) -> VehicleState {
          return (*static_cast<const Model*>(any))(x, water);
        }),
        tangent_([](const void* any, const VehicleState& x) -> BodyTangent {
          return static_cast<const Model*>(any)->tangent(x);
        }) {}

  VehicleState operator()(const VehicleState& x, const Eigen::Vector2d& water) const {
    return call_(model_, x, water);
  }
  BodyTangent tangent(const VehicleState& x) const { return tangent_(model_, x); }

 private:
  const void* model_;
  VehicleState (*call_)(const void*, const VehicleState&, const Eigen::Vector2d&);
  BodyTangent (*tangent_)(const void*, const VehicleState&);
};

/// The estimators of a swarm at work. Different vehicles may be asked for in parallel; nothing is
/// allocated.
class Navigation {
 public:
  virtual ~Navigation() = default;

  /// True if what is believed is the truth, also between samples.
  virtual bool exact() const { return false; }

  /// What vehicle `vehicle` believes at sample `k` = 0, 1, ..., asked for in that order; sample 0
  /// is at the start. `truth` is where it is in water that moves with `water` (m/s, north and
  /// east), and `process` where its own model, under the inputs since the sample before, takes a
  /// state over one period. The estimate stands until the next.
  virtual const Estimate& sample(std::size_t vehicle, std::uint64_t k, const VehicleState& truth,
                                 const Eigen::Vector2d& water, const ProcessRef& process) = 0;
};

/// How a vehicle in six degrees of freedom knows its state.
class Estimator {
 public:
  static constexpr const char* family = "estimator";
  static constexpr const char* family_meaning = "how a vehicle knows its own state";

  virtual ~Estimator() = default;

  /// For vehicles that know their start, are sampled every `period_s` and disturbed by that. Throws
  /// InputError for options that make no filter, a start that is not finite, no period.
  virtual std::unique_ptr<Navigation> launch(const std::vector<VehicleState>& starts,
                                             const ProcessNoise& disturbance,
                                             const RandomStreams& random,
                                             double period_s) const = 0;
};

}  // namespace shoal::scenarios
