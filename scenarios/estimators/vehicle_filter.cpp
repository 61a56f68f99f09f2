#include "shoal/scenarios/estimators/vehicle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::scenarios {
namespace {

/// e^T P^-1 e over the first `size` of a vector, from the lower root of P.
double normalised_square(const BeliefCovariance& root, VehicleBelief e, int size) {
  if (!(root.diagonal().head(size).minCoeff() > 0.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  root.topLeftCorner(size, size).triangularView<Eigen::Lower>().solveInPlace(e.head(size));
  return e.head(size).squaredNorm();
}

VehicleBelief difference(const VehicleBelief& a, const VehicleBelief& b) {
  VehicleBelief d = a - b;
  for (int i = 9; i < 12; ++i) d(i) = wrapped(d(i));
  return d;
}

/// What remains after `step` of a process that decorrelates in `time`.
double kept_share(double step, double time) {
  return std::exp(-step / time);
}

}  // namespace

void VehicleFilterOptions::Water::declare(Options<Water>& o) {
  o.number(
      "sd_m_s", &Water::sd_m_s, "m/s", in(0, 10),
      "standard deviation of each component of the current; 0: the water is taken to be still");
  o.number("time_s", &Water::time_s, "s", above(0),
           "time in which the current that the vehicle meets decorrelates");
}

void VehicleFilterOptions::declare(Options<VehicleFilterOptions>& o) {
  using F = VehicleFilterOptions;
  o.word(
      "propagation", &F::propagation,
      {{"kinematic", Propagation::kinematic},
       {"linearised", Propagation::linearised},
       {"full", Propagation::full}},
      "how sigma points are carried on: as they move, all forces being noise; by the linear terms "
      "of the vehicle's model about a centre that it carries on; or each by that model (29 times "
      "the cost)");
  o.word("doppler", &F::doppler,
         {{"bottom_track", Doppler::bottom_track}, {"water_track", Doppler::water_track}},
         "whether the Doppler log measures the velocity over ground or through the water");
  o.table("water", &F::water, "the current as the filter expects it; it is estimated, too");
  o.table("scaling", &F::scaling, "how sigma points are drawn");
  o.number("gate_sigma", &F::gate_sigma, "", in(0, 100),
           "measurements further than that many standard deviations are outliers; 0: none are");
  o.integer("gate_patience", &F::gate_patience, "", in(1, 1'000'000),
            "outliers in a row after which the filter doubts itself and lets the next one in");
  o.table("sensors", &F::sensors, "the noise of the measurements");
  o.word("measurement_noise", &F::measurement_noise,
         {{"coloured", NoiseModel::coloured},
          {"marginal", NoiseModel::marginal},
          {"white", NoiseModel::white}},
         "what the filter takes the simulated sensor noise for: noise with a memory, of the same "
         "variance and the same long means; or white noise, of the same variance or of the same "
         "long means");
  o.word("process_noise", &F::process_noise,
         {{"marginal", NoiseModel::marginal}, {"white", NoiseModel::white}},
         "what it takes the disturbance for: white noise of the same variance or of the same long "
         "means");
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

UkfSettings<14, 12> VehicleFilterOptions::settings(const ProcessNoise& disturbance,
                                                   double period_s) const {
  UkfSettings<14, 12> made;
  made.scaling = scaling;
  made.process_covariance.setZero();
  made.process_covariance.topLeftCorner<12, 12>() = process_covariance(disturbance, period_s);
  const double kept = kept_share(period_s, water.time_s);
  made.process_covariance.diagonal().tail<2>().setConstant(water.sd_m_s * water.sd_m_s *
                                                           (1.0 - kept * kept));
  made.measurement_covariance =
      simulated_measurement_covariance(sensors, period_s, measurement_noise);
  if (measurement_noise == NoiseModel::coloured) {
    made.measurement_memory = simulated_measurement_memory(sensors, period_s);
  }
  made.state_is_angle = belief_angles;
  made.measurement_is_angle = vehicle_angles;
  made.gate = {gate_sigma, static_cast<int>(gate_patience)};
  return made;
}

VehicleFilter::VehicleFilter(const VehicleFilterOptions& options,
                             const UkfSettings<14, 12>& settings, const VehicleState& start,
                             double period_s)
    : measured_{options.doppler == VehicleFilterOptions::Doppler::bottom_track},
      water_sd_m_s_(options.water.sd_m_s),
      kept_(kept_share(period_s, options.water.time_s)),
      ukf_(settings, (VehicleBelief() << start, 0.0, 0.0).finished(),
           BeliefCovariance::Identity()) {
  ukf_.restart(ukf_.state(), first_covariance());
  estimate_.estimated = water_sd_m_s_ > 0.0 ? 14 : 12;
}

BeliefCovariance VehicleFilter::first_covariance() const {
  BeliefCovariance P = BeliefCovariance::Zero();
  P.diagonal() << ukf_.settings().measurement_covariance.diagonal(),
      Eigen::Vector2d::Constant(water_sd_m_s_ * water_sd_m_s_);
  return P;
}

const Estimate& VehicleFilter::correct(const VehicleState& measured, const VehicleState& truth,
                                       const Eigen::Vector2d& water) {
  // After a prediction that lost itself the estimate is one of the sample before.
  const bool stale = predicted_ == UkfStatus::lost;
  const auto& update = ukf_.correct(measured, measured_);
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
    VehicleBelief found = VehicleBelief::Zero();
    found.head<12>() =
        measured.array().isFinite().select(measured.array(), belief().head<12>().array());
    ukf_.restart(found, first_covariance());
  }
  estimate_.state = belief().head<12>();
  estimate_.water = belief().tail<2>();
  const VehicleBelief sd = ukf_.covariance().diagonal().cwiseSqrt();
  estimate_.sd = sd.head<12>();
  estimate_.water_sd = sd.tail<2>();
  const VehicleBelief is = (VehicleBelief() << truth, water).finished();
  estimate_.nees = normalised_square(ukf_.root(), difference(is, belief()), estimate_.estimated);
  return estimate_;
}

}  // namespace shoal::scenarios
