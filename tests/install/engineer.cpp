// Somebody else's simulator on shoal: vehicles of its own, pings in, targets out.

#include <cmath>
#include <cstdio>
#include <memory>
#include <shoal/formations/planner.hpp>
#include <string>
#include <vector>

using Eigen::Vector2d;
using namespace shoal::formations;

struct Auv {
  Vector2d position;  // metres east and north
  Planner planner;    // one per vehicle
};

// The largest error of a distance between two vehicles: zero in formation, wherever that is.
double formation_error(const std::vector<Auv>& auvs, const Plan& plan) {
  double worst = 0.0;
  for (const Auv& a : auvs) {
    for (const Auv& b : auvs) {
      const int i = a.planner.own_slot(), j = b.planner.own_slot();
      const double planned = (plan.slot(i) - plan.slot(j)).norm();
      worst = std::fmax(worst, std::abs((a.position - b.position).norm() - planned));
    }
  }
  return worst;
}

int main() {
  const std::vector<std::string> names{"anna", "bela", "cleo", "dora"};
  const std::vector<Vector2d> square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  const auto plan = std::make_shared<const Plan>(names, square);
  const std::shared_ptr<const Behaviour> behaviour =
      shoal::Registry<Behaviour>::instance().make("rigid_registration", {}, "behaviour");

  std::vector<Auv> auvs;
  const PingFilterOptions filter{.timeout_s = 10.0};  // no noise: nothing is averaged
  for (const Vector2d& start : {Vector2d(0, 0), {40, 90}, {60, 20}, {-50, 30}}) {
    auvs.push_back({start, Planner(plan, behaviour, names[auvs.size()], filter)});
  }

  for (int second = 0; second < 600; ++second) {
    if (second % 10 == 0) {  // everybody pings, everybody hears
      for (Auv& auv : auvs) {
        for (const Auv& sender : auvs) {
          if (&sender == &auv) continue;
          const Vector2d away = sender.position - auv.position;
          auv.planner.receive({.time_s = double(second),
                               .range_m = away.norm(),
                               .bearing_rad = std::atan2(away.y(), away.x()),
                               .slot = sender.planner.own_slot()},
                              auv.position);
        }
      }
      for (Auv& auv : auvs) auv.planner.plan(second, {.position = auv.position});
    }
    for (Auv& auv : auvs) {  // at most 1 m/s
      const Vector2d way = auv.planner.target_from(auv.position);
      auv.position += way / std::fmax(1.0, way.norm());
    }
  }

  for (const Auv& auv : auvs) {
    const Vector2d target = auv.position + auv.planner.target_from(auv.position);
    std::printf("target (%.2f, %.2f) m\n", target.x(), target.y());
  }
  return formation_error(auvs, *plan) < 1.0 ? 0 : 1;
}
