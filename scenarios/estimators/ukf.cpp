#include "shoal/scenarios/estimators/ukf.hpp"

#include "shoal/scenarios/estimators/vehicle_filter.hpp"

namespace shoal::scenarios {
namespace {

using Propagation = VehicleFilterOptions::Propagation;

class FilteredNavigation final : public Navigation {
 public:
  FilteredNavigation(const VehicleFilterOptions& options, const UkfSettings<12, 12>& settings,
                     const std::vector<VehicleState>& starts, const RandomStreams& random,
                     double period_s)
      : propagation_(options.propagation),
        kinematic_{period_s},
        sensors_(options.sensors, starts.size(), random, period_s) {
    filters_.reserve(starts.size());
    for (const VehicleState& start : starts) filters_.emplace_back(settings, start);
  }

  const Estimate& sample(std::size_t vehicle, std::uint64_t k, const VehicleState& truth,
                         const ProcessRef& process) override {
    VehicleFilter& filter = filters_[vehicle];
    if (k > 0) predict(filter, process);
    return filter.correct(truth + sensors_.sample(vehicle, k), truth);
  }

 private:
  void predict(VehicleFilter& filter, const ProcessRef& process) const {
    const VehicleState& x = filter.ukf().state();
    switch (propagation_) {
      case Propagation::kinematic:
        return filter.predict(kinematic_);
      case Propagation::recentred:
        return filter.predict(Recentred(kinematic_, x, process(x)));
      case Propagation::full:
        return filter.predict(process);
    }
  }

  Propagation propagation_;
  KinematicModel kinematic_;
  SensorBanks sensors_;
  std::vector<VehicleFilter> filters_;
};

struct UkfEstimator final : Estimator {
  explicit UkfEstimator(const VehicleFilterOptions& chosen) : options(chosen) {}

  std::unique_ptr<Navigation> launch(const std::vector<VehicleState>& starts,
                                     const ProcessNoise& disturbance, const RandomStreams& random,
                                     double period_s) const override {
    if (!(period_s > 0.0)) throw InputError("ukf: the period between samples has to be positive");
    UkfSettings<12, 12> settings;
    settings.scaling = options.scaling;
    settings.process_covariance = options.process_covariance(disturbance, period_s);
    settings.measurement_covariance = options.measurement_covariance(period_s);
    settings.state_is_angle = settings.measurement_is_angle = vehicle_angles;
    settings.gate = {options.gate_sigma, static_cast<int>(options.gate_patience)};
    return std::make_unique<FilteredNavigation>(options, settings, starts, random, period_s);
  }

  VehicleFilterOptions options;
};

const Enrol<Estimator, VehicleFilterOptions> enrolled{
    "ukf",
    "scaled unscented Kalman filter on twelve noisy measurements (Barisic et al. 2011, Table 2)",
    [](const VehicleFilterOptions& options) { return std::make_unique<UkfEstimator>(options); }};

}  // namespace
}  // namespace shoal::scenarios
