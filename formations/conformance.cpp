#include "shoal/formations/conformance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>

#include "shoal/core/angles.hpp"
#include "shoal/core/text.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;
using Neighbours = std::vector<Neighbour>;

/// All that a behaviour goes by.
struct Scene {
  Plan plan;
  Neighbours neighbours;
  int own_slot = 0;
  OwnState own = {};
  Vector2d waypoint = {900.0, -400.0};

  Neighbourhood seen() const {
    return {.neighbours = neighbours, .own_slot = own_slot, .own = own, .waypoint = waypoint};
  }
};

/// Numbers that are the same on every machine.
class Draws {
 public:
  double within(double low, double high) { return low + (high - low) * uniform(); }
  Vector2d place(double reach_m) {
    const double x = within(-reach_m, reach_m);
    return {x, within(-reach_m, reach_m)};
  }
  int below(int end) { return static_cast<int>(uniform() * end); }
  std::vector<int> order(int size) {
    std::vector<int> drawn(static_cast<std::size_t>(size));
    std::iota(drawn.begin(), drawn.end(), 0);
    for (std::size_t i = drawn.size(); i > 1; --i) {
      std::swap(drawn[i - 1], drawn[static_cast<std::size_t>(below(static_cast<int>(i)))]);
    }
    return drawn;
  }

 private:
  // Not of RandomStreams: the planner is also built without the library that those need.
  double uniform() { return 0x1p-53 * static_cast<double>(engine_() >> 11U); }

  std::mt19937_64 engine_;
};

Plan plan_with(const std::vector<Vector2d>& slots) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < slots.size(); ++i) names.push_back(std::to_string(i + 1));
  return Plan(names, slots);
}

Plan lattice_of(int columns, int rows, double separation_m) {
  std::vector<Vector2d> slots;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      slots.emplace_back(separation_m * column, separation_m * row);
    }
  }
  return plan_with(slots);
}

Neighbours strangers(Neighbours all) {
  for (Neighbour& n : all) n.slot = anonymous;
  return all;
}

/// A formation that is not yet reached: vehicles near their places, the plan turned somehow.
Scene drawn_scene(Draws& draws, bool ids) {
  constexpr double least_apart_m = 60.0, reach_m = 400.0, astray_m = 50.0;
  std::vector<Vector2d> slots;
  const int size = 4 + draws.below(5);
  while (static_cast<int>(slots.size()) < size) {
    const Vector2d slot = draws.place(reach_m);
    const auto near = [&](const Vector2d& other) { return (slot - other).norm() < least_apart_m; };
    if (std::ranges::none_of(slots, near)) slots.push_back(slot);
  }
  Scene scene{.plan = plan_with(slots), .neighbours = {}};
  scene.own_slot = draws.below(size);
  const Transform2 T_world_plan = Transform2::from_angle(draws.within(-3.0, 3.0), Vector2d::Zero());
  const Vector2d here = T_world_plan * scene.plan.slot(scene.own_slot) + draws.place(astray_m);
  for (int i = 0; i < size; ++i) {
    if (i == scene.own_slot) continue;
    scene.neighbours.push_back({T_world_plan * scene.plan.slot(i) + draws.place(astray_m) - here,
                                draws.within(0.0, 100.0), i, draws.place(0.5),
                                draws.within(-3.0, 3.0)});
  }
  if (!ids) scene.neighbours = strangers(scene.neighbours);
  scene.own = {draws.place(1000.0), draws.place(0.5), draws.within(-3.0, 3.0),
               draws.within(0.1, 1.0), draws.within(-0.1, 0.1)};
  return scene;
}

/// The same scene in a frame that was turned.
Scene turned(Scene scene, const Transform2& turn) {
  const auto rotate = [&](Vector2d& v) { v = turn.rotate(v); };
  for (Neighbour& n : scene.neighbours) {
    rotate(n.position);
    rotate(n.velocity);
    n.heading_rad += turn.angle();
  }
  rotate(scene.own.position);
  rotate(scene.own.velocity);
  rotate(scene.waypoint);
  scene.own.heading_rad += turn.angle();
  return scene;
}

/// The same scene with the slots numbered anew: slot i becomes order[i].
Scene renumbered(Scene scene, const std::vector<int>& order) {
  const auto anew = [&](int slot) { return order[static_cast<std::size_t>(slot)]; };
  std::vector<Vector2d> slots(order.size());
  for (int i = 0; i < scene.plan.size(); ++i) {
    slots[static_cast<std::size_t>(anew(i))] = scene.plan.slot(i);
  }
  scene.plan = plan_with(slots);
  scene.own_slot = anew(scene.own_slot);
  for (Neighbour& n : scene.neighbours) {
    if (n.slot != anonymous) n.slot = anew(n.slot);
  }
  return scene;
}

Scene with_plan_moved(Scene scene, const Transform2& motion) {
  std::vector<Vector2d> slots;
  for (const Vector2d& slot : scene.plan.slots()) slots.push_back(motion * slot);
  scene.plan = plan_with(slots);
  return scene;
}

/// Neighbours that no formation would have, and the worst that pings may report.
std::vector<Neighbours> degenerate_swarms() {
  const std::vector<std::vector<Vector2d>> places{
      {},
      {{200, 0}},
      {{0, 0}},
      {{0, 0}, {0, 0}},
      {{100, 0}, {-100, 0}},
      {{100, 100}, {200, 200}, {300, 300}},
      {{50, 0}, {50, 0}, {50, 0}},
      {{1e-12, 0}, {0, 1e-12}},
      {{1e-300, 0}, {-1e-300, 1e-300}},
      {{649.9999, 0}, {650, 0}, {650.0001, 0}},
      {{1e7, 0}, {0, -1e7}},
  };
  std::vector<Neighbours> swarms;
  for (const auto& each : places) {
    Neighbours& swarm = swarms.emplace_back();
    for (const Vector2d& p : each) swarm.push_back({p, 0.0, static_cast<int>(swarm.size()) + 1});
  }
  Neighbours& crowd = swarms.emplace_back();  // more than the plan has slots
  for (int i = 0; i < 40; ++i) crowd.push_back({{7.0 * i, 3.0 * (i % 5)}, 500.0, anonymous});
  return swarms;
}

std::string shown(const Vector2d& v) {
  return "(" + shortest(v.x()) + ", " + shortest(v.y()) + ")";
}

/// The place or the force of a target.
Vector2d answer_of(const Target& target) {
  return target.force_m_s2.value_or(target.position);
}

class Trial {
 public:
  Trial(const Behaviour& behaviour, const Conformance& asked)
      : behaviour_(behaviour), asked_(asked) {}

  std::vector<std::string> run() {
    on_degenerate_swarms();
    alone();
    among_strangers();
    Draws draws;
    constexpr int scenes = 40;
    for (int i = 0; i < scenes; ++i) symmetries(draws, "drawn swarm " + std::to_string(i));
    return std::move(found_);
  }

 private:
  void on_degenerate_swarms() {
    const Plan plan = lattice_of(4, 3, 300.0);
    for (const Neighbours& swarm : degenerate_swarms()) {
      for (const Neighbours& neighbours : {swarm, strangers(swarm)}) {
        const Scene scene{.plan = plan, .neighbours = neighbours};
        const Target target = step(scene);
        const std::string where = std::to_string(neighbours.size()) + " degenerate neighbours";
        if (!answer_of(target).allFinite() || !std::isfinite(target.cost)) {
          violated("targets and costs are finite", where + ": " + shown(answer_of(target)));
        }
        if (target.held() && target.position != Vector2d::Zero()) {
          violated("the target of a vehicle that holds is its own position",
                   where + ": " + shown(target.position));
        }
      }
    }
  }

  void alone() {
    const Target target = step({.plan = lattice_of(4, 3, 300.0), .neighbours = {}, .own_slot = 3});
    if (behaviour_.needs_waypoint()) {
      if (target.held()) violated("a waypoint leads also a vehicle that hears no other", "");
    } else if (target.reason != Reason::no_neighbour) {
      violated("a vehicle that hears no other holds, for that reason",
               std::string(name_of(target.reason)));
    }
  }

  void among_strangers() {
    Draws draws;
    const Target target = step(drawn_scene(draws, false));
    if (target.held() == behaviour_.needs_ids()) return;
    violated("among strangers a vehicle holds if and only if the behaviour needs ids",
             std::string(name_of(target.reason)));
  }

  void symmetries(Draws& draws, const std::string& where) {
    const Scene scene = drawn_scene(draws, behaviour_.needs_ids());
    const Target target = step(scene), again = step(scene);
    if (answer_of(again) != answer_of(target) || again.cost != target.cost) {
      violated("the same neighbours give the same bits", where);
    }
    together(scene, target, where);

    const auto turn = [&] {
      const auto steps = static_cast<int>(360.0 / asked_.turn_step_deg);
      return Transform2::from_angle(radians(asked_.turn_step_deg * draws.below(steps)),
                                    Vector2d::Zero());
    };
    const Transform2 frame = turn();
    same("the orientation of the frame means nothing", where, target, step(turned(scene, frame)),
         frame);

    Scene moved = scene;
    const Vector2d shift = draws.place(5000.0);
    moved.own.position += shift;
    moved.waypoint += shift;
    same("the origin of the frame means nothing", where, target, step(moved));

    Transform2 motion = turn();
    motion.translation = draws.place(5000.0);
    same("the frame of the plan means nothing", where, target,
         step(with_plan_moved(scene, motion)));
    same("the numbers of the slots mean nothing", where, target,
         step(renumbered(scene, draws.order(scene.plan.size()))));

    Scene mixed = scene;
    const std::vector<int> order = draws.order(static_cast<int>(scene.neighbours.size()));
    for (std::size_t i = 0; i < order.size(); ++i) {
      mixed.neighbours[i] = scene.neighbours[static_cast<std::size_t>(order[i])];
    }
    same("the order of the neighbours means nothing", where, target, step(mixed));
  }

  void together(const Scene& scene, const Target& alone, const std::string& where) {
    const Neighbourhood lonely{
        .neighbours = {}, .own_slot = scene.own_slot, .own = scene.own, .waypoint = scene.waypoint};
    const std::vector<Neighbourhood> seen{lonely, scene.seen()};
    const std::vector<Solving> solving(seen.size());
    std::vector<Target> targets(seen.size());
    behaviour_.step_together(seen, scene.plan, solving, targets);
    same("several vehicles together get what each gets alone", where, alone, targets[1]);
  }

  void same(const std::string& rule, const std::string& where, const Target& before,
            const Target& after, const Transform2& turn = {}) {
    constexpr double share_of_a_force = 1e-6;
    const Vector2d expected = turn.rotate(answer_of(before)), found = answer_of(after);
    const double tolerance =
        before.force_m_s2 ? share_of_a_force * expected.norm() + 1e-12 : asked_.tolerance_m;
    if ((found - expected).norm() <= tolerance && before.reason == after.reason) return;
    violated(rule, where + ": " + shown(found) + " (" + std::string(name_of(after.reason)) +
                       ") instead of " + shown(expected) + " (" +
                       std::string(name_of(before.reason)) + ")");
  }

  Target step(const Scene& scene) const { return behaviour_.step(scene.seen(), scene.plan); }

  /// The first example of each rule.
  void violated(const std::string& rule, const std::string& example) {
    const auto told = [&](const std::string& sentence) { return sentence.starts_with(rule); };
    if (std::ranges::any_of(found_, told)) return;
    found_.push_back(example.empty() ? rule : rule + "; " + example);
  }

  const Behaviour& behaviour_;
  const Conformance asked_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> violations(const Behaviour& behaviour, const Conformance& asked) {
  if (!(asked.turn_step_deg > 0.0 && asked.turn_step_deg <= 90.0)) {
    throw InputError("turn_step_deg is " + shortest(asked.turn_step_deg) +
                     "; it takes a number above 0 and at most 90");
  }
  return Trial(behaviour, asked).run();
}

}  // namespace shoal::formations
