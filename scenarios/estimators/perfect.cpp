#include "shoal/scenarios/estimators/estimator.hpp"

namespace shoal::scenarios {
namespace {

class PerfectNavigation final : public Navigation {
 public:
  explicit PerfectNavigation(std::size_t vehicles) : estimates_(vehicles) {}

  bool exact() const override { return true; }

  const Estimate& sample(std::size_t vehicle, std::uint64_t, const VehicleState& truth,
                         const Eigen::Vector2d& water, const ProcessRef&) override {
    Estimate& estimate = estimates_[vehicle];
    estimate.state = estimate.measured = truth;
    estimate.water = water;
    return estimate;
  }

 private:
  std::vector<Estimate> estimates_;
};

struct Perfect final : Estimator {
  std::unique_ptr<Navigation> launch(const std::vector<VehicleState>& starts, const ProcessNoise&,
                                     const RandomStreams&, double) const override {
    return std::make_unique<PerfectNavigation>(starts.size());
  }

  static void declare(Options<Perfect>&) {}
};

const Register<Estimator, Perfect> registered{"perfect", "the true state, without noise or faults"};

}  // namespace
}  // namespace shoal::scenarios
