// Somebody else's simulator on shoal: vehicles of its own, pings in, targets out.

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <shoal/formations/planner.hpp>

using Eigen::Vector2d;
using namespace shoal::formations;

struct Auv {
  Vector2d position;  // metres east and north
  Planner planner;    // one per vehicle
};

// How far the vehicles are from a square of 100 m sides, whatever its place and direction.
double worst_side_error(const std::vector<Auv>& auvs) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double side = (auvs[i].position - auvs[(i + 1) % 4].position).norm();
    const double diagonal = (auvs[i].position - auvs[(i + 2) % 4].position).norm();
    worst = std::fmax(worst, std::abs(side - 100.0));
    worst = std::fmax(worst, std::abs(diagonal - 100.0 * std::sqrt(2.0)));
  }
  return worst;
}

int main() {
  const auto plan =
      std::make_shared<const Plan>(std::vector<std::string>{"anna", "bela", "cleo", "dora"},
                                   std::vector<Vector2d>{{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  const std::shared_ptr<const Behaviour> behaviour =
      shoal::Registry<Behaviour>::instance().make("rigid_registration", {}, "behaviour");

  std::vector<Auv> auvs;
  for (const Vector2d& start : {Vector2d(0, 0), {40, 90}, {60, 20}, {-50, 30}}) {
    const std::string name = plan->name(static_cast<int>(auvs.size()));
    auvs.push_back({start, Planner(plan, behaviour, name)});
  }

  for (int second = 0; second < 600; ++second) {
    if (second % 10 == 0) {  // everybody pings, everybody hears
      for (Auv& auv : auvs) {
        for (const Auv& sender : auvs) {
          if (&sender == &auv) continue;
          const Vector2d away = sender.position - auv.position;
          auv.planner.receive({.time_s = 1.0 * second,
                               .range_m = away.norm(),
                               .bearing_rad = std::atan2(away.y(), away.x()),
                               .slot = sender.planner.own_slot()},
                              auv.position);
        }
      }
      for (Auv& auv : auvs) auv.planner.plan(second, auv.position);
    }
    for (Auv& auv : auvs) {  // 1 m/s through the water, less when it is almost there
      const Vector2d way = auv.planner.target_from(auv.position);
      auv.position += way * std::fmin(1.0, 1.0 / (way.norm() + 1e-9));
    }
  }

  for (const Auv& auv : auvs) {
    const Vector2d target = auv.planner.target_from(auv.position);
    std::printf("%s is at (%.1f, %.1f) m, its target (%.1f, %.1f) m away\n",
                plan->name(auv.planner.own_slot()).c_str(), auv.position.x(), auv.position.y(),
                target.x(), target.y());
  }
  return worst_side_error(auvs) < 1.0 ? 0 : 1;
}
