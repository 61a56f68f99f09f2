#include <limits>

#include "planner_arguments.hpp"
#include "shoal/core/options_impl.hpp"
#include "shoal/formations/planner.hpp"
#include "shoal/scenarios/obstacles.hpp"

namespace shoal::python {
namespace {

using formations::Behaviour;
using formations::OwnState;
using formations::Ping;
using formations::Plan;

Plan plan_of_slots(const py::object& slots, const py::object& names) {
  std::vector<std::string> all = texts_argument(names, "names");
  const std::vector<Eigen::Vector2d> places = points(slots, "slots");
  if (all.empty()) {
    for (std::size_t i = 0; i < places.size(); ++i) all.push_back(std::to_string(i + 1));
  }
  return Plan(all, places);
}

std::unique_ptr<formations::PlanSource> plan_source(const py::object& name,
                                                    const py::dict& options) {
  const std::string kind = text_argument(name, "kind");
  return Registry<formations::PlanSource>::instance().make(kind, to_setting(options),
                                                           "plan." + kind);
}

py::array_t<double> slots_of(const Plan& plan) {
  py::array_t<double> array({plan.size(), 2});
  for (int i = 0; i < plan.size(); ++i) {
    array.mutable_at(i, 0) = plan.slot(i).x();
    array.mutable_at(i, 1) = plan.slot(i).y();
  }
  return array;
}

formations::PingFilterOptions filter_options(const Setting& options) {
  formations::PingFilterOptions filter;
  shoal::read(filter, options, "ping_filter");
  return filter;
}

/// A planner with all that it needs to live.
class Planner {
 public:
  Planner(const Plan& plan, const std::string& behaviour, const std::string& vehicle,
          const Setting& options, const Setting& ping_filter, const std::vector<Setting>& obstacles,
          const std::optional<Eigen::Vector2d>& waypoint,
          const std::optional<std::string>& guidance, const Setting& guidance_options)
      : plan_(std::make_shared<Plan>(plan)),
        behaviour_(
            Registry<Behaviour>::instance().make(behaviour, options, "behaviour." + behaviour)),
        guidance_(make_guidance(
            guidance ? *guidance : formations::guidance_for(behaviour_->gives_forces()),
            guidance_options)),
        obstacles_(make_obstacles(obstacles)),
        planner_(plan_, behaviour_, vehicle,
                 {.ping_filter = filter_options(ping_filter),
                  .guidance = guidance_,
                  .obstacles = obstacles_,
                  .waypoint = waypoint}) {}

  void receive(const py::object& ping, const py::object& position) {
    planner_.receive(ping_argument(ping, "ping"), place_argument(position, "position"));
  }

  Eigen::Vector2d plan(const py::object& time_s, const OwnState& own) {
    planner_.plan(number_argument(time_s, "time_s"), own);
    return planner_.target_from(own.position);
  }

  Eigen::Vector2d target(const py::object& given) const {
    const Eigen::Vector2d position = place_argument(given, "position");
    if (!position.allFinite()) throw InputError("the position is not finite; give metres");
    return planner_.target_from(position);
  }

  formations::Command command(const py::object& own) {
    if (!is_state(own) && guidance_->needs_motion()) {
      throw InputError("this guidance goes by how the vehicle moves; give an OwnState");
    }
    return planner_.command(state_or_place(own, "own"));
  }

  double command_period_s() const { return guidance_->period_s(); }
  std::string_view reason() const { return name_of(planner_.last_target().reason); }
  std::optional<Eigen::Vector2d> force() const { return planner_.last_target().force_m_s2; }
  double cost() const { return planner_.last_target().cost; }
  const Plan& formation() const { return *plan_; }

 private:
  static std::shared_ptr<const formations::Guidance> make_guidance(const std::string& kind,
                                                                   const Setting& options) {
    return Registry<formations::Guidance>::instance().make(kind, options, "guidance." + kind);
  }

  static std::vector<std::shared_ptr<const formations::Obstacle>> make_obstacles(
      const std::vector<Setting>& list) {
    std::vector<scenarios::ObstacleOptions> options;
    for (const Setting& each : list) shoal::read(options.emplace_back(), each, "obstacle");
    return scenarios::make_obstacles(options);
  }

  // Copies share what never changes.
  std::shared_ptr<const Plan> plan_;
  std::shared_ptr<const Behaviour> behaviour_;
  std::shared_ptr<const formations::Guidance> guidance_;
  std::vector<std::shared_ptr<const formations::Obstacle>> obstacles_;
  formations::Planner planner_;
};

void add_plan(py::module_& module) {
  py::class_<Plan>(module, "Plan",
                   "The geometry that a swarm should take: named slots, metres, in a frame of its\n"
                   "own whose place and orientation mean nothing.")
      .def(py::init(&plan_of_slots), py::arg("slots"), py::arg("names") = py::tuple(),
           "slots: array (slots, 2); names default to 1, 2 ... Raises InputError.")
      .def_static(
          "of",
          [](const py::object& kind, const py::kwargs& options) {
            return plan_source(kind, options)->plan();
          },
          py::arg("kind"),
          "A plan by kind and options, as in a scenario: Plan.of(\"square\", rows=4).")
      .def_static(
          "padded",
          [](const py::object& kind, const py::object& layers, const py::kwargs& options) {
            const auto added = integer_argument(layers, "layers", 0, formations::most_layers);
            return plan_source(kind, options)->padded(static_cast<int>(added));
          },
          py::arg("kind"), py::arg("layers") = 1,
          "The same with up to 100 more lattice positions on every side, for formation_quality().\n"
          "Raises InputError.")
      .def("__len__", &Plan::size)
      .def_property_readonly("slots", &slots_of, "Array (slots, 2), metres.")
      .def_property_readonly(
          "names",
          [](const Plan& plan) {
            return std::vector<std::string>(plan.names().begin(), plan.names().end());
          },
          "Of the slots, in their order.")
      .def(
          "index_of",
          [](const Plan& plan, const py::object& name) {
            return plan.index_of(text_argument(name, "name"));
          },
          py::arg("name"), "Raises InputError if there is no slot of that name.");
}

template <double OwnState::*member>
void add_number(py::class_<OwnState>& state, const char* name) {
  state.def_property(
      name, [](const OwnState& own) { return own.*member; },
      [name](OwnState& own, const py::object& value) {
        own.*member = number_argument(value, name);
      });
}

template <Eigen::Vector2d OwnState::*member>
void add_place(py::class_<OwnState>& state, const char* name) {
  state.def_property(name,
                     py::cpp_function([](OwnState& own) -> Eigen::Vector2d& { return own.*member; },
                                      py::return_value_policy::reference_internal),
                     [name](OwnState& own, const py::object& value) {
                       own.*member = place_argument(value, name);
                     });
}

void add_own_state(py::module_& module) {
  py::class_<OwnState> state(module, "OwnState",
                             "How a vehicle moves. Metres east and north in any fixed frame; "
                             "angles counter-clockwise from\n"
                             "east. Raises InputError.");
  state.def(
      py::init([](const py::object& position, const py::object& velocity,
                  const py::object& heading_rad, const py::object& speed_m_s,
                  const py::object& turn_rate_rad_s) {
        return OwnState{place_argument(position, "position"), place_argument(velocity, "velocity"),
                        number_argument(heading_rad, "heading_rad"),
                        number_argument(speed_m_s, "speed_m_s"),
                        number_argument(turn_rate_rad_s, "turn_rate_rad_s")};
      }),
      py::arg("position"), py::kw_only(), py::arg("velocity") = py::make_tuple(0.0, 0.0),
      py::arg("heading_rad") = 0.0, py::arg("speed_m_s") = 0.0, py::arg("turn_rate_rad_s") = 0.0);
  add_place<&OwnState::position>(state, "position");
  add_place<&OwnState::velocity>(state, "velocity");
  add_number<&OwnState::heading_rad>(state, "heading_rad");
  add_number<&OwnState::speed_m_s>(state, "speed_m_s");
  add_number<&OwnState::turn_rate_rad_s>(state, "turn_rate_rad_s");
}

Ping ping_of(const py::object& time_s, const py::object& range_m, const py::object& bearing_rad,
             const py::object& elevation_rad, const py::object& slot, const py::object& state) {
  return {.time_s = number_argument(time_s, "time_s"),
          .range_m = number_argument(range_m, "range_m"),
          .bearing_rad = number_argument(bearing_rad, "bearing_rad"),
          .elevation_rad = number_argument(elevation_rad, "elevation_rad"),
          .slot = static_cast<int>(integer_argument(slot, "slot", formations::anonymous,
                                                    std::numeric_limits<int>::max())),
          .state = state_or_none(state, "state")};
}

Planner planner_of(const py::object& plan, const py::object& behaviour, const py::object& vehicle,
                   const py::object& options, const py::object& ping_filter,
                   const py::object& obstacles, const py::object& waypoint,
                   const py::object& guidance, const py::object& guidance_options) {
  return {plan_argument(plan, "plan"),
          text_argument(behaviour, "behaviour"),
          text_argument(vehicle, "vehicle"),
          settings_argument(options, "options"),
          settings_argument(ping_filter, "ping_filter"),
          list_of_settings(obstacles, "obstacles"),
          place_or_none(waypoint, "waypoint"),
          text_or_none(guidance, "guidance"),
          settings_argument(guidance_options, "guidance_options")};
}

}  // namespace

void add_planners(py::module_& module) {
  add_plan(module);

  add_own_state(module);

  py::class_<Ping>(
      module, "Ping",
      "One acoustic ping as the receiver measured it. Bearing: to the sender,\n"
      "counter-clockwise from east. slot: the sender's in the plan, or -1 if the ping\n"
      "carries no id. state: what the sender says of itself, if it does. Raises InputError.")
      .def(py::init(&ping_of), py::kw_only(), py::arg("time_s"), py::arg("range_m"),
           py::arg("bearing_rad"), py::arg("elevation_rad") = 0.0,
           py::arg("slot") = formations::anonymous, py::arg("state") = py::none())
      .def_readonly("time_s", &Ping::time_s)
      .def_readonly("range_m", &Ping::range_m)
      .def_readonly("bearing_rad", &Ping::bearing_rad)
      .def_readonly("elevation_rad", &Ping::elevation_rad)
      .def_readonly("slot", &Ping::slot);

  using formations::PingFilter;
  py::class_<PingFilter>(module, "PingFilter",
                         "Keeps track of the neighbours of one vehicle from their pings: Rypkema "
                         "2015, Alg. 3. Options as\n"
                         "in a scenario's ping_filter. Raises InputError.")
      .def(py::init([](const py::object& options) {
             return PingFilter(filter_options(settings_argument(options, "options")));
           }),
           py::arg("options") = py::dict())
      .def(
          "receive",
          [](PingFilter& filter, const py::object& ping, const py::object& position) {
            filter.receive(ping_argument(ping, "ping"), place_argument(position, "position"));
          },
          py::arg("ping"), py::arg("position"),
          "A ping was heard while the vehicle was at `position`. In time order.")
      .def(
          "neighbours",
          [](PingFilter& filter, const py::object& time_s, const py::object& position) {
            const auto found = filter.neighbours(number_argument(time_s, "time_s"),
                                                 place_argument(position, "position"));
            py::array_t<double> places({static_cast<py::ssize_t>(found.size()), py::ssize_t{2}});
            for (std::size_t i = 0; i < found.size(); ++i) {
              places.mutable_at(i, 0) = found[i].position.x();
              places.mutable_at(i, 1) = found[i].position.y();
            }
            return places;
          },
          py::arg("time_s"), py::arg("position"),
          "Array (neighbours, 2), metres relative to the vehicle, in the order first heard.");

  using formations::Command;
  py::class_<Command>(module, "Command",
                      "What a vehicle's own controllers are asked for. thrust: False to drift, "
                      "then the heading is\n"
                      "free. heading_rad: counter-clockwise from east. acceleration_m_s2 and "
                      "turn_rate_rad_s: on the\n"
                      "way there, for controllers that ask. outside_envelope: the vehicle moves in "
                      "a way from which\n"
                      "its envelope allows no command.")
      .def_readonly("thrust", &Command::thrust)
      .def_readonly("heading_rad", &Command::heading_rad)
      .def_readonly("speed_m_s", &Command::speed_m_s)
      .def_readonly("acceleration_m_s2", &Command::acceleration_m_s2)
      .def_readonly("turn_rate_rad_s", &Command::turn_rate_rad_s)
      .def_readonly("outside_envelope", &Command::outside_envelope);

  py::class_<Planner>(
      module, "Planner",
      "The formation planner of one vehicle, for a simulator or a real vehicle: pings in, targets\n"
      "and commands out. behaviour, options, ping_filter and obstacles (a list of dicts such as\n"
      "{'shape': {'kind': 'circle', 'circle': {'radius_m': 9}}}) are those of a scenario; "
      "vehicle:\n"
      "the name of the own slot; waypoint: (east, north), for behaviours that lead to one;\n"
      "guidance: a kind of shoal.catalogue('guidance'), by default one that fits the behaviour\n"
      "(conditioned_force for forces, which then asks for an OwnState).\n"
      "Positions: metres east and north in any fixed frame (dead reckoning will do), which is "
      "that\n"
      "of obstacles and waypoint, too. copy.copy(planner) goes on with the same numbers.\n"
      "Raises InputError.")
      .def(py::init(&planner_of), py::arg("plan"), py::arg("behaviour"), py::arg("vehicle"),
           py::arg("options") = py::dict(), py::arg("ping_filter") = py::dict(),
           py::arg("obstacles") = py::tuple(), py::arg("waypoint") = py::none(),
           py::arg("guidance") = py::none(), py::arg("guidance_options") = py::dict())
      .def("__copy__", [](const Planner& planner) { return Planner(planner); })
      .def(
          "__deepcopy__", [](const Planner& planner, const py::dict&) { return Planner(planner); },
          py::arg("memo"))
      .def(
          "receive", &Planner::receive, py::arg("ping"), py::arg("position"),
          "A ping was heard while the vehicle was at `position`. In time order. Raises InputError.")
      .def(
          "plan",
          [](Planner& planner, const py::object& time_s, const py::object& own) {
            return planner.plan(time_s, state_or_place(own, "own"));
          },
          py::arg("time_s"), py::arg("own"),
          "Plans anew and returns the target relative to the vehicle (east, north), metres.")
      .def(
          "plan",
          [](Planner& planner, const py::object& time_s, const py::object& position) {
            return planner.plan(time_s, {.position = place_argument(position, "position")});
          },
          py::arg("time_s"), py::arg("position"))
      .def("target", &Planner::target, py::arg("position"),
           "The last target relative to where the vehicle is now, metres. Zero before any plan().\n"
           "Raises InputError.")
      .def("command", &Planner::command, py::arg("own"),
           "Heading and speed on the way to the last target, or to drift. To be called every\n"
           "command_period_s. own: an OwnState, or a position where the guidance asks for no more.")
      .def_property_readonly("command_period_s", &Planner::command_period_s,
                             "Time between two commands, s.")
      .def_property_readonly("reason", &Planner::reason, "Why the target is what it is.")
      .def_property_readonly(
          "force", &Planner::force,
          "m/s2 east and north, of behaviours that answer with a force; else None.")
      .def_property_readonly("cost", &Planner::cost, "Of the solved problem, in its own unit.")
      .def_property_readonly("formation", &Planner::formation, "The plan.",
                             py::return_value_policy::reference_internal);
}

}  // namespace shoal::python
