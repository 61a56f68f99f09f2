#include "conversions.hpp"
#include "shoal/core/options_impl.hpp"
#include "shoal/formations/planner.hpp"
#include "shoal/scenarios/obstacles.hpp"

namespace shoal::python {
namespace {

using formations::Behaviour;
using formations::OwnState;
using formations::Ping;
using formations::Plan;

Plan plan_of_slots(const py::object& slots, const std::vector<std::string>& names) {
  std::vector<std::string> all = names;
  const std::vector<Eigen::Vector2d> places = points(slots, "slots");
  if (all.empty()) {
    for (std::size_t i = 0; i < places.size(); ++i) all.push_back(std::to_string(i + 1));
  }
  return Plan(all, places);
}

std::unique_ptr<formations::PlanSource> plan_source(const std::string& kind,
                                                    const py::dict& options) {
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

formations::PingFilterOptions filter_options(const py::dict& options) {
  formations::PingFilterOptions filter;
  shoal::read(filter, to_setting(options), "ping_filter");
  return filter;
}

/// A planner with all that it needs to live.
class Planner {
 public:
  Planner(const Plan& plan, const std::string& behaviour, const std::string& vehicle,
          const py::dict& options, const py::dict& ping_filter, const py::list& obstacles,
          const std::optional<Eigen::Vector2d>& waypoint,
          const std::optional<std::string>& guidance, const py::dict& guidance_options)
      : plan_(std::make_shared<Plan>(plan)),
        behaviour_(Registry<Behaviour>::instance().make(behaviour, to_setting(options),
                                                        "behaviour." + behaviour)),
        guidance_(make_guidance(
            guidance ? *guidance : formations::guidance_for(behaviour_->gives_forces()),
            guidance_options)),
        obstacles_(make_obstacles(obstacles)),
        planner_(plan_, behaviour_, vehicle,
                 {.ping_filter = filter_options(ping_filter),
                  .guidance = guidance_,
                  .obstacles = obstacles_,
                  .waypoint = waypoint}) {}

  void receive(const Ping& ping, const Eigen::Vector2d& position) {
    planner_.receive(ping, position);
  }

  Eigen::Vector2d plan(double time_s, const OwnState& own) {
    planner_.plan(time_s, own);
    return planner_.target_from(own.position);
  }

  Eigen::Vector2d target(const Eigen::Vector2d& position) const {
    if (!position.allFinite()) throw InputError("the position is not finite; give metres");
    return planner_.target_from(position);
  }

  formations::Command command(const OwnState& own) { return planner_.command(own); }

  formations::Command command_at(const Eigen::Vector2d& position) {
    if (guidance_->needs_motion()) {
      throw InputError("this guidance goes by how the vehicle moves; give an OwnState");
    }
    return planner_.command({.position = position});
  }

  double command_period_s() const { return guidance_->period_s(); }
  std::string_view reason() const { return name_of(planner_.last_target().reason); }
  std::optional<Eigen::Vector2d> force() const { return planner_.last_target().force_m_s2; }
  double cost() const { return planner_.last_target().cost; }
  const Plan& formation() const { return *plan_; }

 private:
  static std::shared_ptr<const formations::Guidance> make_guidance(const std::string& kind,
                                                                   const py::dict& options) {
    return Registry<formations::Guidance>::instance().make(kind, to_setting(options),
                                                           "guidance." + kind);
  }

  static std::vector<std::shared_ptr<const formations::Obstacle>> make_obstacles(
      const py::list& list) {
    std::vector<scenarios::ObstacleOptions> options;
    for (const py::handle each : list) {
      options.emplace_back();
      shoal::read(options.back(), to_setting(each), "obstacle");
    }
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
      .def(py::init(&plan_of_slots), py::arg("slots"),
           py::arg("names") = std::vector<std::string>{},
           "slots: array (slots, 2); names default to 1, 2 ... Raises InputError.")
      .def_static(
          "of",
          [](const std::string& kind, const py::kwargs& options) {
            return plan_source(kind, options)->plan();
          },
          py::arg("kind"),
          "A plan by kind and options, as in a scenario: Plan.of(\"square\", rows=4).")
      .def_static(
          "padded",
          [](const std::string& kind, const py::object& layers, const py::kwargs& options) {
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
          "index_of", [](const Plan& plan, const std::string& name) { return plan.index_of(name); },
          py::arg("name"), "Raises InputError if there is no slot of that name.");
}

}  // namespace

void add_planners(py::module_& module) {
  add_plan(module);

  py::class_<OwnState>(module, "OwnState",
                       "How a vehicle moves. Metres east and north in any fixed frame; angles "
                       "counter-clockwise from\n"
                       "east.")
      .def(py::init([](const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                       double heading_rad, double speed_m_s, double turn_rate_rad_s) {
             return OwnState{position, velocity, heading_rad, speed_m_s, turn_rate_rad_s};
           }),
           py::arg("position"), py::kw_only(), py::arg("velocity") = Eigen::Vector2d(0, 0),
           py::arg("heading_rad") = 0.0, py::arg("speed_m_s") = 0.0,
           py::arg("turn_rate_rad_s") = 0.0)
      .def_readwrite("position", &OwnState::position)
      .def_readwrite("velocity", &OwnState::velocity)
      .def_readwrite("heading_rad", &OwnState::heading_rad)
      .def_readwrite("speed_m_s", &OwnState::speed_m_s)
      .def_readwrite("turn_rate_rad_s", &OwnState::turn_rate_rad_s);

  py::class_<Ping>(
      module, "Ping",
      "One acoustic ping as the receiver measured it. Bearing: to the sender,\n"
      "counter-clockwise from east. slot: the sender's in the plan, or -1 if the ping\n"
      "carries no id. state: what the sender says of itself, if it does.")
      .def(py::init([](double time_s, double range_m, double bearing_rad, double elevation_rad,
                       int slot, const std::optional<OwnState>& state) {
             return Ping{time_s, range_m, bearing_rad, elevation_rad, slot, state};
           }),
           py::kw_only(), py::arg("time_s"), py::arg("range_m"), py::arg("bearing_rad"),
           py::arg("elevation_rad") = 0.0, py::arg("slot") = formations::anonymous,
           py::arg("state") = std::nullopt)
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
      .def(py::init([](const py::dict& options) { return PingFilter(filter_options(options)); }),
           py::arg("options") = py::dict())
      .def("receive", &PingFilter::receive, py::arg("ping"), py::arg("position"),
           "A ping was heard while the vehicle was at `position`. In time order.")
      .def(
          "neighbours",
          [](PingFilter& filter, double time_s, const Eigen::Vector2d& position) {
            const auto found = filter.neighbours(time_s, position);
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
      .def(py::init<const Plan&, const std::string&, const std::string&, const py::dict&,
                    const py::dict&, const py::list&, const std::optional<Eigen::Vector2d>&,
                    const std::optional<std::string>&, const py::dict&>(),
           py::arg("plan"), py::arg("behaviour"), py::arg("vehicle"),
           py::arg("options") = py::dict(), py::arg("ping_filter") = py::dict(),
           py::arg("obstacles") = py::list(), py::arg("waypoint") = std::nullopt,
           py::arg("guidance") = std::nullopt, py::arg("guidance_options") = py::dict())
      .def("__copy__", [](const Planner& planner) { return Planner(planner); })
      .def(
          "__deepcopy__", [](const Planner& planner, const py::dict&) { return Planner(planner); },
          py::arg("memo"))
      .def(
          "receive", &Planner::receive, py::arg("ping"), py::arg("position"),
          "A ping was heard while the vehicle was at `position`. In time order. Raises InputError.")
      .def("plan", &Planner::plan, py::arg("time_s"), py::arg("own"),
           "Plans anew and returns the target relative to the vehicle (east, north), metres.")
      .def(
          "plan",
          [](Planner& planner, double time_s, const Eigen::Vector2d& position) {
            return planner.plan(time_s, {.position = position});
          },
          py::arg("time_s"), py::arg("position"))
      .def("target", &Planner::target, py::arg("position"),
           "The last target relative to where the vehicle is now, metres. Zero before any plan().\n"
           "Raises InputError.")
      .def("command", &Planner::command, py::arg("own"),
           "Heading and speed on the way to the last target, or to drift. To be called every\n"
           "command_period_s. own: an OwnState, or a position where the guidance asks for no more.")
      .def(
          "command",
          [](Planner& planner, const Eigen::Vector2d& position) {
            return planner.command_at(position);
          },
          py::arg("own"))
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
