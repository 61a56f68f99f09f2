#include "world_view.hpp"

namespace shoal::python {
namespace {

using scenarios::World;

/// A number of each vehicle.
template <class Number, class Of>
py::array_t<Number> of_vehicles(const World& world, Of of) {
  py::array_t<Number> array(static_cast<py::ssize_t>(world.size()));
  for (std::size_t i = 0; i < world.size(); ++i) {
    array.mutable_at(static_cast<py::ssize_t>(i)) = of(i);
  }
  return array;
}

template <class Of>
Array pairs_of_vehicles(const World& world, Of of) {
  Array array({static_cast<py::ssize_t>(world.size()), py::ssize_t{2}});
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Eigen::Vector2d pair = of(i);
    array.mutable_at(static_cast<py::ssize_t>(i), 0) = pair.x();
    array.mutable_at(static_cast<py::ssize_t>(i), 1) = pair.y();
  }
  return array;
}

Array positions(const WorldView& view) {
  const World& w = view.world();
  return pairs_of_vehicles(
      w, [&](std::size_t i) { return Eigen::Vector2d(w.swarm().x_m[i], w.swarm().y_m[i]); });
}

Array own_positions(const WorldView& view) {
  const World& w = view.world();
  return pairs_of_vehicles(w, [&](std::size_t i) { return w.swarm().own_position(i); });
}

Array targets(const WorldView& view) {
  const World& w = view.world();
  return pairs_of_vehicles(
      w, [&](std::size_t i) { return w.planner(i).target_from(w.swarm().own_position(i)); });
}

Array currents(const WorldView& view) {
  const World& w = view.world();
  return pairs_of_vehicles(w, [&](std::size_t i) { return w.current_m_s(i); });
}

Array slots(const WorldView& view) {
  const formations::Plan& plan = view.world().plan();
  return pairs_of_vehicles(view.world(),
                           [&](std::size_t i) { return plan.slot(static_cast<int>(i)); });
}

}  // namespace

py::object WorldView::show(const World& world, const py::object& method) {
  const auto view = std::make_shared<WorldView>(world);
  struct Close {
    WorldView& view;
    ~Close() { view.world_ = nullptr; }
  } const at_the_end{*view};
  return method(view);
}

const World& WorldView::world() const {
  if (!world_) throw InputError("the world is only there while the method runs; keep its numbers");
  return *world_;
}

void add_world_view(py::module_& module) {
  const auto of_swarm = [](const std::vector<double>& (*get)(const scenarios::Swarm&)) {
    return [get](const WorldView& view) {
      const World& w = view.world();
      return of_vehicles<double>(w, [&](std::size_t i) { return get(w.swarm())[i]; });
    };
  };
  using scenarios::Swarm;
  using Numbers = const std::vector<double>&;
  py::class_<WorldView, std::shared_ptr<WorldView>>(
      module, "World",
      "A swarm in its sea, as a measure sees it: the truth, vehicle by vehicle in the order of "
      "their\n"
      "slots. Metres east and north; angles counter-clockwise from east.")
      .def("__len__", [](const WorldView& view) { return view.world().size(); })
      .def_property_readonly(
          "time_s", [](const WorldView& view) { return view.world().time_s(); },
          "Since mission start.")
      .def_property_readonly("slots", &slots, "Array (vehicles, 2): of the plan.")
      .def_property_readonly("positions", &positions, "Array (vehicles, 2).")
      .def_property_readonly("own_positions", &own_positions,
                             "Array (vehicles, 2): where vehicles believe that they are.")
      .def_property_readonly("targets", &targets,
                             "Array (vehicles, 2): from a vehicle to its target; zero while it "
                             "holds.")
      .def_property_readonly("current_m_s", &currents, "Array (vehicles, 2): the water's velocity.")
      .def_property_readonly("depths_m",
                             of_swarm([](const Swarm& s) -> Numbers { return s.depth_m; }),
                             "Positive down.")
      .def_property_readonly("headings_rad",
                             of_swarm([](const Swarm& s) -> Numbers { return s.heading_rad; }))
      .def_property_readonly("speeds_m_s",
                             of_swarm([](const Swarm& s) -> Numbers { return s.speed_m_s; }),
                             "Forward, through water.")
      .def_property_readonly(
          "energy_wh",
          [](const WorldView& view) {
            const World& w = view.world();
            return of_vehicles<double>(w, [&](std::size_t i) {
              return w.propulsion_wh(i) + w.hotel_wh(i) + w.comms_wh(i);
            });
          },
          "Spent since mission start.")
      .def_property_readonly(
          "lost",
          [](const WorldView& view) {
            const World& w = view.world();
            return of_vehicles<bool>(w, [&](std::size_t i) { return w.lost(i); });
          },
          "Which vehicles are gone.");
}

}  // namespace shoal::python
