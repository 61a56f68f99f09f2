#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// Where the first vehicle wants to go at the end of the trial, as seen from it: for behaviours
/// before made-up neighbours (Rypkema 2015, fig. 3.7). Nothing while it holds its place, or if its
/// behaviour asks for a force.
class FirstTarget final : public Measure {
 public:
  static void declare(Options<FirstTarget>&) {}

  std::vector<Quantity> values() const override {
    return {{"target_x_m", "m", "target of the first vehicle, east of it, at the end"},
            {"target_y_m", "m", "target of the first vehicle, north of it, at the end"}};
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::optional<Eigen::Vector2d> target;
    if (!world.lost(0)) {
      const formations::Planner& planner = world.planner(0);
      const bool place = !planner.last_target().held() && !planner.last_target().force_m_s2;
      if (place) target = planner.target_from(world.swarm().own_position(0));
    }
    results.add("target_x_m", target ? std::optional(target->x()) : std::nullopt);
    results.add("target_y_m", target ? std::optional(target->y()) : std::nullopt);
  }
};

const Register<Measure, FirstTarget> registered{"target", "where the first vehicle wants to go"};

}  // namespace
}  // namespace shoal::analysis
