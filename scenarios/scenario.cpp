#include "shoal/scenarios/scenario.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/calendar.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/moved_keys.hpp"
#include "shoal/solvers/matching/matching.hpp"

namespace shoal::scenarios {
namespace {

// Beyond that, doubles do not hold every tick.
constexpr double most_ticks = 1e15;

}  // namespace

void TrialOptions::declare(Options<TrialOptions>& o) {
  using T = TrialOptions;
  o.number("duration_s", &T::duration_s, "s", above(0),
           "length of the mission, unless a rule ends it earlier");
  o.integer("seed", &T::seed, "", in(0, 9e15),
            "seed of all random numbers; same seed, same bits, and 0 is a seed like any other");
  o.number("record_every_s", &T::record_every_s, "s", at_least(0),
           "how often the state is recorded (0: never); a multiple of tick_s");
  o.number("tick_s", &T::tick_s, "s", in(1e-3, 10),
           "the instants at which vehicles listen, plan and are guided; the author's helm: 4 Hz");
  o.text("start", &T::start, "UTC of mission start, for the time axis of run.nc");
  o.flag("time_solves", &T::time_solves,
         "measure the time that solvers take: solve_time_s, which no seed makes again");
}

void SwarmOptions::declare(Options<SwarmOptions>& o) {
  o.choice("vehicle", &SwarmOptions::vehicle, "how the vehicles move");
  o.choice("start", &SwarmOptions::start, "where the vehicles are at mission start");
}

void PlannerOptions::declare(Options<PlannerOptions>& o) {
  using P = PlannerOptions;
  o.word("update", &P::update, {{"ping", Update::ping}, {"tick", Update::tick}},
         "plan when pings were heard, or every period_s whatever was heard (the author's program)");
  o.number("period_s", &P::period_s, "s", above(0),
           "time between two plans if update is \"tick\"; a multiple of trial.tick_s");
}

void Waypoint::declare(Options<Waypoint>& o) {
  o.number("x_m", &Waypoint::x_m, "m", {}, "east of the origin");
  o.number("y_m", &Waypoint::y_m, "m", {}, "north of the origin");
  o.number("radius_m", &Waypoint::radius_m, "m", above(0),
           "a vehicle has arrived once it was as near as this");
  o.flag("ends_trial", &Waypoint::ends_trial, "the trial ends when all vehicles have arrived");
}

std::optional<std::string> Waypoint::complaint() const {
  if (std::isfinite(x_m) && std::isfinite(y_m)) return std::nullopt;
  return "set both x_m and y_m";
}

void QualityOptions::declare(Options<QualityOptions>& o) {
  using Q = QualityOptions;
  o.number("every_s", &Q::every_s, "s", at_least(0),
           "how often the quality is measured (0: never); a multiple of trial.tick_s");
  o.integer("layers", &Q::layers, "", in(0, formations::most_layers),
            "lattice positions added around the plan (Rypkema 2015, sec. 4.3)");
  o.word("alignment", &Q::alignment,
         {{"rigid", Alignment::rigid},
          {"centroid", Alignment::centroid},
          {"nearest_point", Alignment::nearest_point}},
         "how the plan is laid onto the vehicles: the best of all rigid motions; or two points on "
         "top of one another before rotating by steps: the centroids (sec. 4.3), or the points "
         "nearest to them (the author's program)");
  o.number("tolerance_m", &Q::tolerance_m, "m", above(0),
           "how far above its proven lower bound the quality may be, if alignment is \"rigid\"");
  o.integer("budget", &Q::budget, "", in(1, 1e10),
            "distances looked at before the proof is given up with a wider gap, for one instant, "
            "if alignment is \"rigid\"");
  o.number("delta_theta_deg", &Q::delta_theta_deg, "deg", solvers::delta_theta_range_deg(),
           "step of the rotations, if alignment is \"centroid\" or \"nearest_point\"");
}

void Scenario::declare(Options<Scenario>& o) {
  using S = Scenario;
  o.table("trial", &S::trial, "length, seed and recording");
  o.choice("stop", &S::stop, "ends the trial before its duration");
  o.table("swarm", &S::swarm, "the vehicles and their starts");
  o.choice("plan", &S::plan, "the geometry the swarm should take");
  o.choice("behaviour", &S::behaviour, "turns what was heard into a target");
  o.table("planner", &S::planner, "when targets are renewed");
  o.table("ping_filter", &S::ping_filter, "averaging and forgetting of what was heard");
  o.choice("guidance", &S::guidance, "turns targets into headings and speeds, or drift");
  o.table("waypoint", &S::waypoint, "where vehicles are led to, if their behaviour leads");
  o.table("ping", &S::ping, "the acoustic channel");
  o.choice("current", &S::current, "the motion of the water");
  o.tables("obstacle", &S::obstacles, "what vehicles keep clear of, if their behaviour does");
  o.table("energy", &S::energy, "what the consumers draw");
  o.choice("faults", &S::faults, "what goes wrong on purpose");
  o.table("quality", &S::quality, "how the formation quality is measured");
  // Measures are known above this layer only; without it there is nothing to give options to.
  if (const RegistryBase* measures = family_named("measure")) {
    o.members("measure", &S::measures, *measures, "options of measures");
  }
}

std::int64_t ticks_of(double period_s, double tick_s, const std::string& key) {
  const double ratio = period_s / tick_s;
  const double whole = std::round(ratio);
  if (whole > most_ticks) {
    throw InputError(key + " is " + shortest(period_s) + " s; it must be at most " +
                     shortest(most_ticks * tick_s) + " s");
  }
  if (whole < 1.0 || std::abs(ratio - whole) > 1e-9 * whole) {
    throw InputError(key + " is " + shortest(period_s) +
                     " s; it must be a multiple of trial.tick_s = " + shortest(tick_s) + " s");
  }
  return static_cast<std::int64_t>(whole);
}

namespace {

/// Checks of values that are each in range but must also go together.
class CrossChecks {
 public:
  CrossChecks(const Scenario& scenario, const Setting& root) : s_(scenario), root_(root) {}

  void run() const {
    times();
    hearing();
    way();
    end();
  }

 private:
  using Keys = std::initializer_list<std::string>;

  /// Points at the first of these keys that was written.
  [[noreturn]] void refuse(Keys keys, const std::string& why) const {
    for (const std::string& key : keys) {
      if (const Setting* written = root_.find_path(key)) throw InputError(written->origin, why);
    }
    throw InputError(root_.origin, why);
  }

  void whole_ticks(double period_s, const std::string& key) const {
    try {
      ticks_of(period_s, s_.trial.tick_s, key);
    } catch (const InputError& error) {
      refuse({key, "trial.tick_s"}, error.what());
    }
  }

  void countable_ticks(double time_s, const std::string& key) const {
    const double most_s = most_ticks * s_.trial.tick_s;
    if (time_s <= most_s) return;
    refuse({key},
           key + " is " + shortest(time_s) + " s; it must be at most " + shortest(most_s) + " s");
  }

  void times() const {
    const double tick = s_.trial.tick_s;
    whole_ticks(s_.trial.duration_s, "trial.duration_s");
    whole_ticks(s_.guidance.make()->period_s(), "guidance." + s_.guidance.kind() + ".period_s");
    if (s_.planner.update == PlannerOptions::Update::tick) {
      whole_ticks(s_.planner.period_s, "planner.period_s");
    }
    if (s_.trial.record_every_s > 0.0) whole_ticks(s_.trial.record_every_s, "trial.record_every_s");
    if (s_.quality.every_s > 0.0) whole_ticks(s_.quality.every_s, "quality.every_s");
    const auto fault = s_.faults.make();
    if (fault->count() > 0) {
      whole_ticks(fault->every_s(), "faults." + s_.faults.kind() + ".every_s");
    }
    countable_ticks(s_.ping.period_s, "ping.period_s");
    countable_ticks(s_.ping.first_s, "ping.first_s");
    countable_ticks(s_.ping_filter.contact_timeout_s, "ping_filter.contact_timeout_s");
    if (s_.ping.period_s < tick) {
      refuse({"ping.period_s", "trial.tick_s"},
             "ping.period_s is " + shortest(s_.ping.period_s) +
                 " s; it must be at least trial.tick_s = " + shortest(tick) + " s");
    }
    if (const auto why = s_.swarm.vehicle.make()->refuses_tick(tick)) {
      refuse({"swarm.vehicle." + s_.swarm.vehicle.kind(), "trial.tick_s"}, *why);
    }
    try {
      parse_instant(s_.trial.start, Calendar::standard);
    } catch (const InputError& error) {
      refuse({"trial.start"}, "trial.start: " + std::string(error.what()));
    }
  }

  void hearing() const {
    if (s_.ping.identified) return;
    if (s_.behaviour.make()->needs_ids()) {
      refuse({"ping.identified"},
             "behaviour " + s_.behaviour.kind() +
                 " needs to know which vehicle pings; set ping.identified = true");
    }
    if (s_.ping_filter.rest_s >= s_.ping.period_s) {
      refuse({"ping_filter.rest_s", "ping.period_s"},
             "ping_filter.rest_s must be shorter than ping.period_s, or every ping without id "
             "would begin a new track");
    }
  }

  void way() const {
    const auto behaviour = s_.behaviour.make();
    const std::string name = "behaviour " + s_.behaviour.kind();
    if (behaviour->needs_waypoint() && !s_.waypoint) {
      refuse({"behaviour.kind"}, name + " leads to a waypoint; set waypoint.x_m and waypoint.y_m");
    }
    if (behaviour->gives_forces() != s_.guidance.make()->takes_forces()) {
      refuse({"guidance.kind", "behaviour.kind"},
             name + " gives " + (behaviour->gives_forces() ? "forces" : "places") +
                 ", which guidance " + s_.guidance.kind() +
                 " does not take; set guidance.kind = \"" +
                 formations::guidance_for(behaviour->gives_forces()) + '"');
    }
    if (s_.planner.update == PlannerOptions::Update::tick || !behaviour->needs_clock()) return;
    refuse(
        {"planner.update", "behaviour.kind"},
        name +
            (behaviour->needs_waypoint() ? " leads vehicles that hear no other, too"
                                         : " goes by the own motion, which changes between pings") +
            "; set planner.update = \"tick\"");
  }

  void end() const {
    if (const auto why = s_.stop.make()->refuses_quality_every(s_.quality.every_s)) {
      refuse({"stop." + s_.stop.kind(), "stop.kind", "quality.every_s"},
             "stop." + s_.stop.kind() + ": " + *why);
    }
  }

  const Scenario& s_;
  const Setting& root_;
};

/// `inherits` is no option of a scenario, but may have been meant.
void require_known_names(const Setting& root) {
  std::vector<std::string> known = schema_of<Scenario>().names();
  known.emplace_back(inherits_key);
  for (const auto& [name, value] : root.table()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw InputError(value.origin,
                     "a scenario has no option \"" + name + '"' + suggestion(name, known));
  }
}

}  // namespace

Scenario read_scenario(const Setting& root) {
  if (root.table().empty() && !root.origin.file.empty()) {
    throw InputError(root.origin,
                     "the scenario says nothing; it takes tables such as [plan] and [behaviour]");
  }
  TomlFiles files;
  const Setting settings = with_inherited(root, files).settings;
  require_no_moved_keys(settings);
  require_known_names(settings);
  Scenario scenario;
  read(scenario, settings, "");
  CrossChecks(scenario, settings).run();
  return scenario;
}

std::filesystem::path find_scenario(const std::string& name_or_path) {
  namespace fs = std::filesystem;
  if (fs::exists(name_or_path)) return name_or_path;
  const fs::path in_library = library_path() / (name_or_path + ".toml");
  if (fs::exists(in_library)) return in_library;
  throw InputError("there is no file \"" + name_or_path +
                   "\", and no scenario of that name in the library" +
                   suggestion(name_or_path, library_scenarios()));
}

Setting resolved_scenario(const Scenario& scenario) {
  return write_options(schema_of<Scenario>(), &scenario);
}

}  // namespace shoal::scenarios
