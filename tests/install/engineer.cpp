// A simulator on shoal: vehicles of its own; pings in, headings and speeds out.

#include <cmath>
#include <cstdio>
#include <memory>
#include <shoal/formations/behaviours/rigid_registration.hpp>
#include <shoal/formations/guidances/drift.hpp>
#include <shoal/formations/planner.hpp>
#include <string>
#include <vector>

using Eigen::Vector2d;
using namespace shoal::formations;

struct Auv {
  Vector2d position;  // metres east and north
  Planner planner;    // one per vehicle
};

int main() {
  const std::vector<std::string> names{"anna", "bela", "cleo", "dora"};
  const std::vector<Vector2d> square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  const auto plan = std::make_shared<const Plan>(names, square);
  const std::shared_ptr<const Behaviour> rigid =
      shoal::make<Behaviour>(RigidRegistration{.ownship_weight = 0.5});
  const auto drift = std::make_shared<const Drift>(DriftOptions{.period_s = 1.0});

  std::vector<Auv> auvs;
  for (const Vector2d& start : {Vector2d(0, 0), {40, 90}, {60, 20}, {-50, 30}}) {
    auvs.push_back({start, Planner(plan, rigid, names[auvs.size()], {.guidance = drift})});
  }

  for (int second = 0; second < 1200; ++second) {
    for (Auv& auv : auvs) {
      for (const Auv& sender : auvs) {  // all ping every 10 s, and hear one another
        if (second % 10 != 0 || &sender == &auv) continue;
        const Vector2d away = sender.position - auv.position;
        auv.planner.receive({.time_s = double(second),
                             .range_m = away.norm(),
                             .bearing_rad = std::atan2(away.y(), away.x()),
                             .slot = sender.planner.own_slot()},
                            auv.position);
      }
      if (second % 10 == 0) auv.planner.plan(second, {.position = auv.position});
    }
    for (Auv& auv : auvs) {
      const Command command = auv.planner.command({.position = auv.position});
      if (!command.thrust) continue;  // it drifts near its target
      auv.position += command.speed_m_s *
                      Vector2d(std::cos(command.heading_rad), std::sin(command.heading_rad));
    }
  }

  double farthest = 0.0;
  for (const Auv& auv : auvs) {
    const double away = auv.planner.target_from(auv.position).norm();
    std::printf("%s: %.1f m from its target\n", names[size_t(auv.planner.own_slot())].c_str(),
                away);
    farthest = std::fmax(farthest, away);
  }
  return farthest <= 20.0 ? 0 : 1;
}
