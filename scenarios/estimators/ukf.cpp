#include "shoal/scenarios/estimators/ukf.hpp"

#include "shoal/scenarios/estimators/vehicle_filter.hpp"

namespace shoal::scenarios {
namespace {

using Propagation = VehicleFilterOptions::Propagation;

class FilteredNavigation final : public Navigation {
 public:
  FilteredNavigation(const VehicleFilterOptions& options, const UkfSettings<14, 12>& settings,
                     const std::vector<VehicleState>& starts, const RandomStreams& random,
                     double period_s)
      : propagation_(options.propagation),
        kinematic_{period_s},
        sensors_(options.sensors, starts.size(), random, period_s) {
    filters_.reserve(starts.size());
    for (const VehicleState& start : starts)
      filters_.emplace_back(options, settings, start, period_s);
  }

  const Estimate& sample(std::size_t vehicle, std::uint64_t k, const VehicleState& truth,
                         const Eigen::Vector2d& water, const ProcessRef& process) override {
    VehicleFilter& filter = filters_[vehicle];
    if (k > 0) predict(filter, process);
    return filter.correct(filter.measured(truth, water) + sensors_.sample(vehicle, k), truth,
                          water);
  }

 private:
  void predict(VehicleFilter& filter, const ProcessRef& process) const {
    const auto carried = [&process](const VehicleBelief& x) -> VehicleState {
      return process(x.head<12>(), x.tail<2>());
    };
    switch (propagation_) {
      case Propagation::kinematic:
        return filter.predict(kinematic_);
      case Propagation::linearised:
        return filter.predict(Linearised(kinematic_, filter.belief(), carried(filter.belief()),
                                         process.tangent(filter.belief().head<12>())));
      case Propagation::full:
        return filter.predict([&](const VehicleBelief& x) -> VehicleBelief {
          return (VehicleBelief() << carried(x), x.tail<2>()).finished();
        });
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
    return std::make_unique<FilteredNavigation>(options, options.settings(disturbance, period_s),
                                                starts, random, period_s);
  }

  VehicleFilterOptions options;
};

const Register<Estimator, VehicleFilterOptions> registered{
    "ukf",
    "scaled unscented Kalman filter on twelve noisy measurements, with the current as two "
    "states more (Barisic et al. 2011, Table 2)",
    [](const VehicleFilterOptions& options) { return std::make_unique<UkfEstimator>(options); }};

}  // namespace
}  // namespace shoal::scenarios
