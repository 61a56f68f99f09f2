#include <cmath>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::analysis {
namespace {

/// How far the formation has turned: the angle of the plan laid onto the vehicles (each on the slot
/// of its own name), followed through full turns, counter-clockwise positive.
class Rotation final : public Measure {
 public:
  static void declare(Options<Rotation>&) {}

  std::vector<Quantity> values() const override {
    return {{"formation_rotation_deg", "deg", "how far the formation has turned"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = log_interval_s(world); }

  void observe(const scenarios::World& world) override {
    solvers::Procrustes registration;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i)) continue;
      registration.add(world.plan().slot(static_cast<int>(i)),
                       {world.swarm().x_m[i], world.swarm().y_m[i]}, 1.0);
    }
    const solvers::RegistrationSolution fit = registration.solve();
    if (fit.status != solvers::Status::converged) return;
    const double angle = fit.T_to_from.angle();
    angle_ = angle_ ? *angle_ + wrapped(angle - *angle_) : angle;
  }

  void finish(const scenarios::World&, Results& results) const override {
    results.add("formation_rotation_deg", angle_ ? std::optional(degrees(*angle_)) : std::nullopt);
  }

 private:
  std::optional<double> angle_;
};

const Register<Measure, Rotation> registered{
    "rotation", "the turning of the plan laid onto the vehicles, followed through full turns"};

}  // namespace
}  // namespace shoal::analysis
