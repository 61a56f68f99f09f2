#include "neighbourhoods.hpp"

#include <algorithm>
#include <limits>

#include "python_class.hpp"

namespace shoal::python {
namespace {

using formations::Neighbour;
using formations::Obstacle;
using formations::Plan;
using Integers = py::array_t<std::int64_t>;
using Flags = py::array_t<bool>;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What one and many have in common.
struct Surroundings {
  Array plan;  ///< slots, m
  Array waypoint;
  std::vector<std::shared_ptr<const Obstacle>> obstacles;

  /// Distance and outward normal; infinity where there is no obstacle.
  py::tuple nearest_obstacle(const py::object& place) const {
    const Eigen::VectorXd at = vector_argument(place, "place");
    if (at.size() != 2 || !at.allFinite()) throw InputError("place takes two finite numbers");
    double distance = std::numeric_limits<double>::infinity();
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    for (const auto& obstacle : obstacles) {
      const formations::Proximity near = obstacle->nearest(at);
      if (near.distance >= distance) continue;
      distance = near.distance;
      normal = near.normal;
    }
    return py::make_tuple(distance, normal);
  }
};

struct One : Surroundings {
  Array positions, velocities, ages_s, headings_rad;
  Integers slots;
  int own_slot = 0;
  formations::OwnState own;
};

struct Many : Surroundings {
  Array positions, velocities, ages_s, headings_rad;
  Integers slots;
  Flags present;
  Integers own_slots;
  Array own_positions, own_velocities, own_headings_rad, own_speeds_m_s;
};

Array pair_of(const Eigen::Vector2d& v) {
  Array array(py::ssize_t{2});
  array.mutable_at(0) = v.x();
  array.mutable_at(1) = v.y();
  return array;
}

Array slots_of(const Plan& plan) {
  Array slots({static_cast<py::ssize_t>(plan.size()), py::ssize_t{2}});
  for (int i = 0; i < plan.size(); ++i) {
    slots.mutable_at(i, 0) = plan.slot(i).x();
    slots.mutable_at(i, 1) = plan.slot(i).y();
  }
  return slots;
}

void surround(Surroundings& all, const formations::Neighbourhood& seen, const Plan& plan) {
  all.plan = slots_of(plan);
  all.waypoint = pair_of(seen.waypoint);
  all.obstacles.assign(seen.obstacles.begin(), seen.obstacles.end());
}

template <class Class>
void add_common(Class& bound) {
  bound.def_readonly("plan", &Surroundings::plan)
      .def_readonly("waypoint", &Surroundings::waypoint)
      .def("nearest_obstacle", &Surroundings::nearest_obstacle, py::arg("place"));
}

}  // namespace

py::object one_neighbourhood(const formations::Neighbourhood& seen, const Plan& plan) {
  const auto n = static_cast<py::ssize_t>(seen.neighbours.size());
  One one;
  surround(one, seen, plan);
  one.own_slot = seen.own_slot;
  one.own = seen.own;
  one.positions = Array({n, py::ssize_t{2}});
  one.velocities = Array({n, py::ssize_t{2}});
  one.ages_s = Array(n);
  one.headings_rad = Array(n);
  one.slots = Integers(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const Neighbour& each = seen.neighbours[static_cast<std::size_t>(i)];
    for (py::ssize_t axis = 0; axis < 2; ++axis) {
      one.positions.mutable_at(i, axis) = each.position[axis];
      one.velocities.mutable_at(i, axis) = each.velocity[axis];
    }
    one.ages_s.mutable_at(i) = each.age_s;
    one.headings_rad.mutable_at(i) = each.heading_rad;
    one.slots.mutable_at(i) = each.slot;
  }
  return py::cast(std::move(one));
}

py::object many_neighbourhoods(std::span<const formations::Neighbourhood> seen, const Plan& plan) {
  const auto vehicles = static_cast<py::ssize_t>(seen.size());
  std::size_t longest = 0;
  for (const auto& each : seen) longest = std::max(longest, each.neighbours.size());
  const auto most = static_cast<py::ssize_t>(longest);
  const std::vector<py::ssize_t> flat{vehicles, most}, pairs{vehicles, most, 2};
  Many many;
  surround(many, seen.front(), plan);
  many.positions = Array(pairs);
  many.velocities = Array(pairs);
  many.ages_s = Array(flat);
  many.headings_rad = Array(flat);
  many.slots = Integers(flat);
  many.present = Flags(flat);
  many.own_slots = Integers(vehicles);
  many.own_positions = Array({vehicles, py::ssize_t{2}});
  many.own_velocities = Array({vehicles, py::ssize_t{2}});
  many.own_headings_rad = Array(vehicles);
  many.own_speeds_m_s = Array(vehicles);
  for (py::ssize_t v = 0; v < vehicles; ++v) {
    const formations::Neighbourhood& one = seen[static_cast<std::size_t>(v)];
    many.own_slots.mutable_at(v) = one.own_slot;
    many.own_headings_rad.mutable_at(v) = one.own.heading_rad;
    many.own_speeds_m_s.mutable_at(v) = one.own.speed_m_s;
    for (py::ssize_t axis = 0; axis < 2; ++axis) {
      many.own_positions.mutable_at(v, axis) = one.own.position[axis];
      many.own_velocities.mutable_at(v, axis) = one.own.velocity[axis];
    }
    for (py::ssize_t i = 0; i < most; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Neighbour* each = k < one.neighbours.size() ? &one.neighbours[k] : nullptr;
      many.present.mutable_at(v, i) = each != nullptr;
      many.slots.mutable_at(v, i) = each ? each->slot : formations::anonymous;
      many.ages_s.mutable_at(v, i) = each ? each->age_s : unknown;
      many.headings_rad.mutable_at(v, i) = each ? each->heading_rad : unknown;
      for (py::ssize_t axis = 0; axis < 2; ++axis) {
        many.positions.mutable_at(v, i, axis) = each ? each->position[axis] : unknown;
        many.velocities.mutable_at(v, i, axis) = each ? each->velocity[axis] : unknown;
      }
    }
  }
  return py::cast(std::move(many));
}

void add_neighbourhoods(py::module_& module) {
  py::class_<One> one(
      module, "Neighbourhood",
      "What a vehicle knows when it plans. Metres east and north.\n\n"
      "positions: array (neighbours, 2), relative to the vehicle; velocities: (neighbours, 2), "
      "m/s,\n"
      "and headings_rad: (neighbours,), counter-clockwise from east, zero where pings carry no\n"
      "state; ages_s: since each was last heard; slots: theirs in the plan, -1 without ids;\n"
      "own_slot; own: an OwnState; plan: (slots, 2); waypoint: (2,), zero where there is none.\n"
      "nearest_obstacle(place): distance (m, negative inside, inf without obstacles) and outward\n"
      "normal; place, waypoint and own.position are in the frame of own positions.");
  one.def_readonly("positions", &One::positions)
      .def_readonly("velocities", &One::velocities)
      .def_readonly("ages_s", &One::ages_s)
      .def_readonly("headings_rad", &One::headings_rad)
      .def_readonly("slots", &One::slots)
      .def_readonly("own_slot", &One::own_slot)
      .def_readonly("own", &One::own);
  add_common(one);
  py::class_<Many> many(
      module, "Neighbourhoods",
      "What several vehicles know that plan at one instant: as Neighbourhood, each array with the\n"
      "vehicles first. positions: (vehicles, most, 2), NaN where a vehicle has fewer neighbours\n"
      "than the most; present: (vehicles, most), which there are; own_slots: (vehicles,);\n"
      "own_positions and own_velocities: (vehicles, 2); own_headings_rad and own_speeds_m_s:\n"
      "(vehicles,).");
  many.def_readonly("positions", &Many::positions)
      .def_readonly("velocities", &Many::velocities)
      .def_readonly("ages_s", &Many::ages_s)
      .def_readonly("headings_rad", &Many::headings_rad)
      .def_readonly("slots", &Many::slots)
      .def_readonly("present", &Many::present)
      .def_readonly("own_slots", &Many::own_slots)
      .def_readonly("own_positions", &Many::own_positions)
      .def_readonly("own_velocities", &Many::own_velocities)
      .def_readonly("own_headings_rad", &Many::own_headings_rad)
      .def_readonly("own_speeds_m_s", &Many::own_speeds_m_s);
  add_common(many);
}

}  // namespace shoal::python
