#pragma once

// Swarms for the tests of behaviours: as planned, moved, relabelled, or drawn by rapidcheck.

#include <rapidcheck.h>

#include <initializer_list>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "shoal/core/transform.hpp"
#include "shoal/formations/behaviour.hpp"

namespace shoal::formations::tests {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;
using Neighbours = std::vector<Neighbour>;

/// Dotted names and values: {{"separation_m", 100.0}, {"solver.kind", "nlopt.mma"}}.
using Table = std::initializer_list<std::pair<const char*, decltype(Setting::value)>>;

inline const std::string rigid_kind = "rigid_registration";
inline const std::string pairwise_kind = "pairwise_referencing";

inline std::unique_ptr<Behaviour> behaviour(std::string_view kind, Table options = {}) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, Setting{value, {}});
  return Registry<Behaviour>::instance().make(kind, table, "test");
}

inline Plan plan_of(const Points& slots) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < slots.size(); ++i) names.push_back("v" + std::to_string(i));
  return Plan(names, slots);
}

/// For behaviours that do not look at the plan.
inline const Plan unused_plan = plan_of({{0, 0}});

/// Slot 0 in the middle of four others.
inline const Plan cross_plan = plan_of({{0, 0}, {100, 0}, {0, 100}, {-100, 0}, {0, -100}});

inline Plan square_lattice(int columns, int rows, double separation_m) {
  Points slots;
  for (int i = 0; i < columns * rows; ++i) {
    slots.emplace_back(separation_m * (i % columns), separation_m * (i / columns));
  }
  return plan_of(slots);
}

/// What the vehicle of `own_slot` hears of all others: the plan moved by `T_world_plan`, and the
/// vehicle itself `displaced` (m, world axes) from its place in it.
inline Neighbours heard(const Plan& plan, int own_slot, const Transform2& T_world_plan = {},
                        const Vector2d& displaced = Vector2d::Zero()) {
  const Vector2d own = T_world_plan * plan.slot(own_slot) + displaced;
  Neighbours all;
  for (int i = 0; i < plan.size(); ++i) {
    if (i != own_slot) all.push_back({T_world_plan * plan.slot(i) - own, 0.0, i});
  }
  return all;
}

inline Neighbours neighbours_at(std::initializer_list<Vector2d> positions) {
  Neighbours all;
  for (const Vector2d& p : positions) all.push_back({p, 0.0, anonymous});
  return all;
}

inline Neighbours without_ids(Neighbours all) {
  for (Neighbour& n : all) n.slot = anonymous;
  return all;
}

inline Transform2 rotation(double angle) {
  return Transform2::from_angle(angle, Vector2d::Zero());
}

inline Neighbours turned(Neighbours all, const Transform2& turn) {
  for (Neighbour& n : all) n.position = turn.rotate(n.position);
  return all;
}

inline Plan moved(const Plan& plan, const Transform2& motion) {
  Points slots;
  for (const Vector2d& slot : plan.slots()) slots.push_back(motion * slot);
  return plan_of(slots);
}

/// The same geometry with the slots numbered anew: slot i becomes slot `new_index[i]`.
inline Plan renumbered(const Plan& plan, const std::vector<int>& new_index) {
  Points slots(new_index.size());
  for (int i = 0; i < plan.size(); ++i) {
    slots[static_cast<std::size_t>(new_index[static_cast<std::size_t>(i)])] = plan.slot(i);
  }
  return plan_of(slots);
}

// Draws; inside rc::check() only. Full range whatever rapidcheck's size, so that the first cases
// are no swarms of centimetres.

inline int drawn_int(int least, int most) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(least, most + 1));
}

inline double drawn_angle() {
  return drawn_int(-180'000, 180'000) * (std::numbers::pi / 180'000.0);
}

/// On a grid of centimetres, |x| and |y| up to `reach_m`.
inline Vector2d drawn_point(int reach_m) {
  return {0.01 * drawn_int(-100 * reach_m, 100 * reach_m),
          0.01 * drawn_int(-100 * reach_m, 100 * reach_m)};
}

/// Slots at least 5 m from one another, within `reach_m`.
inline Plan drawn_plan(int least, int most, int reach_m = 400) {
  const int size = drawn_int(least, most);
  Points slots;
  while (static_cast<int>(slots.size()) < size) {
    slots.push_back(drawn_point(reach_m));
    for (std::size_t i = 0; i + 1 < slots.size(); ++i) {
      RC_PRE((slots[i] - slots.back()).norm() > 5.0);
    }
  }
  return plan_of(slots);
}

inline Transform2 drawn_motion() {
  return Transform2::from_angle(drawn_angle(), drawn_point(5000));
}

/// Neighbours near, but not at, their places: a formation that is not yet reached.
inline Neighbours drawn_neighbours(const Plan& plan, int own_slot) {
  Neighbours all = heard(plan, own_slot, rotation(drawn_angle()), drawn_point(60));
  for (Neighbour& n : all) {
    n.position += drawn_point(60);
    n.age_s = drawn_int(0, 119);
  }
  return all;
}

inline std::vector<int> drawn_order(int size) {
  std::vector<int> order;
  for (int i = 0; i < size; ++i) order.push_back(i);
  for (int i = size - 1; i > 0; --i) {
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(drawn_int(0, i))]);
  }
  return order;
}

inline Neighbours shuffled(const Neighbours& all) {
  Neighbours mixed;
  for (const int i : drawn_order(static_cast<int>(all.size()))) {
    mixed.push_back(all[static_cast<std::size_t>(i)]);
  }
  return mixed;
}

}  // namespace shoal::formations::tests
