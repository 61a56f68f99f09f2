#include "shoal/scenarios/estimators/vehicle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::scenarios {
namespace {

/// e^T P^-1 e from the lower root of P.
double normalised_square(const VehicleCovariance& root, VehicleState e) {
  if (!(root.diagonal().minCoeff() > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  root.triangularView<Eigen::Lower>().solveInPlace(e);
  return e.squaredNorm();
}

VehicleState difference(const VehicleState& a, const VehicleState& b) {
  VehicleState d = a - b;
  for (int i = 9; i < 12; ++i) d(i) = wrapped(d(i));
  return d;
}

}  // namespace

void VehicleFilterOptions::declare(Options<VehicleFilterOptions>& o) {
  using F = VehicleFilterOptions;
  o.word("propagation", &F::propagation,
         {{"kinematic", Propagation::kinematic},
          {"recentred", Propagation::recentred},
          {"full", Propagation::full}},
         "how sigma points are carried on: as they move, the same about a centre that the "
         "vehicle's model carries on, or each by that model (25 times the cost)");
  o.table("scaling", &F::scaling, "how sigma points are drawn");
  o.number("gate_sigma", &F::gate_sigma, "", in(0, 100),
           "measurements further than that many standard deviations are outliers; 0: none are");
  o.integer("gate_patience", &F::gate_patience, "", in(1, 1'000'000),
            "outliers in a row after which the filter doubts itself and lets the next one in");
  o.table("sensors", &F::sensors, "the noise of the measurements");
  o.word("measurement_noise", &F::measurement_noise,
         {{"marginal", NoiseModel::marginal}, {"white", NoiseModel::white}},
         "what of the simulated sensor noise the filter takes for its covariance: the variance of "
         "a sample, or that of white noise with the same long means");
  o.word("process_noise", &F::process_noise,
         {{"marginal", NoiseModel::marginal}, {"white", NoiseModel::white}},
         "the same, of the disturbance");
  o.number("model_error_m_s2", &F::model_error_m_s2, "m/s^2", at_least(0),
           "standard deviation of linear accelerations that the filter's model does not know");
  o.number("model_error_rad_s2", &F::model_error_rad_s2, "rad/s^2", at_least(0),
           "standard deviation of angular accelerations that the filter's model does not know");
}

VehicleCovariance VehicleFilterOptions::process_covariance(const ProcessNoise& disturbance,
                                                           double period_s) const {
  BodyCovariance acceleration = BodyCovariance::Zero();
  if (disturbance.on) {
    acceleration = simulated_disturbance_covariance(disturbance, period_s, process_noise);
  }
  acceleration.diagonal().head<3>().array() += model_error_m_s2 * model_error_m_s2;
  acceleration.diagonal().tail<3>().array() += model_error_rad_s2 * model_error_rad_s2;
  VehicleCovariance R = VehicleCovariance::Zero();
  R.topLeftCorner<6, 6>() = period_s * period_s * acceleration;
  // What they move in the same time turns with the attitude; it is small, and taken without
  // direction.
  const double moved = 0.5 * period_s * period_s;
  R.diagonal().segment<3>(6).setConstant(moved * moved *
                                         acceleration.diagonal().head<3>().maxCoeff());
  R.diagonal().tail<3>().setConstant(moved * moved * acceleration.diagonal().tail<3>().maxCoeff());
  return R;
}

const Estimate& VehicleFilter::correct(const VehicleState& measured, const VehicleState& truth) {
  // After a prediction that lost itself the estimate is one of the sample before.
  const bool stale = predicted_ == UkfStatus::lost;
  const auto& update = ukf_.correct(measured, [](const VehicleState& x) { return x; });
  estimate_.measured = measured;
  estimate_.innovation = update.innovation;
  estimate_.nis = update.nis;
  estimate_.used = update.used;
  estimate_.faulty = update.missing;
  estimate_.rejected = update.rejected;
  estimate_.readmitted = update.readmitted;
  estimate_.status = std::max(predicted_, update.status);
  predicted_ = UkfStatus::ok;
  if (stale || estimate_.status == UkfStatus::lost) {
    const VehicleState found =
        measured.array().isFinite().select(measured.array(), ukf_.state().array());
    ukf_.restart(found, first_covariance(ukf_.settings()));
  }
  estimate_.state = ukf_.state();
  estimate_.sd = ukf_.covariance().diagonal().cwiseSqrt();
  estimate_.nees = normalised_square(ukf_.root(), difference(truth, estimate_.state));
  return estimate_;
}

}  // namespace shoal::scenarios
