#include "shoal/scenarios/behaviour_choice.hpp"

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/guidance.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::scenarios {

void choose_behaviour(Setting& root, const std::string& kind) {
  const auto behaviour =
      Registry<formations::Behaviour>::instance().make(kind, {}, formations::Behaviour::family);
  apply_set(root, "behaviour.kind=" + kind);
  if (behaviour->needs_clock()) apply_set(root, "planner.update=tick");
  if (behaviour->needs_waypoint() && !root.find("waypoint")) {
    apply_set(root, "waypoint={x_m=500,y_m=0}");
  }
  apply_set(root, "guidance.kind=" + formations::guidance_for(behaviour->gives_forces()));
}

}  // namespace shoal::scenarios
