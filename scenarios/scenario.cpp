#include "shoal/scenarios/scenario.hpp"

#include <cmath>

#include "shoal/core/text.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::scenarios {

void TrialOptions::declare(Options<TrialOptions>& o) {
  using T = TrialOptions;
  o.number("duration_s", &T::duration_s, "s", above(0), "length of the mission");
  o.integer("seed", &T::seed, "", in(0, 9e15),
            "seed of all random numbers; same seed, same bits, and 0 is a seed like any other");
  o.number("record_every_s", &T::record_every_s, "s", at_least(0),
           "how often the state is recorded (0: never); a multiple of tick_s");
  o.number("tick_s", &T::tick_s, "s", in(1e-3, 10),
           "the instants at which vehicles listen, plan and are guided; the author's helm: 4 Hz");
  o.text("start", &T::start, "UTC of mission start, for the time axis of run.nc");
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

void NodeLoss::declare(Options<NodeLoss>& o) {
  o.number("every_s", &NodeLoss::every_s, "s", at_least(0), "time between two losses");
  o.integer("count", &NodeLoss::count, "", in(0, 1e6), "how many vehicles are lost in all");
}

std::optional<std::string> NodeLoss::complaint() const {
  if (count > 0 && every_s <= 0.0) return "count is set, so every_s must be above 0 s";
  return std::nullopt;
}

void Faults::declare(Options<Faults>& o) {
  o.table("node_loss", &Faults::node_loss, "random vehicles fall silent for good");
}

void QualityOptions::declare(Options<QualityOptions>& o) {
  using Q = QualityOptions;
  o.number("every_s", &Q::every_s, "s", at_least(0),
           "how often the quality is measured (0: never); a multiple of trial.tick_s");
  o.integer("layers", &Q::layers, "", in(0, 100),
            "lattice positions added around the plan (Rypkema 2015, sec. 4.3)");
  o.word("alignment", &Q::alignment,
         {{"centroid", Alignment::centroid}, {"nearest_point", Alignment::nearest_point}},
         "what is laid on top of one another before rotating: the centroids (sec. 4.3), or the "
         "points nearest to them (the author's program)");
  o.number("delta_theta_deg", &Q::delta_theta_deg, "deg", {0, 180, false},
           "step of the search over rotations");
}

void Scenario::declare(Options<Scenario>& o) {
  using S = Scenario;
  o.table("trial", &S::trial, "length, seed and recording");
  o.table("swarm", &S::swarm, "the vehicles and their starts");
  o.choice("plan", &S::plan, "the geometry the swarm should take");
  o.choice("behaviour", &S::behaviour, "turns what was heard into a target");
  o.table("planner", &S::planner, "when targets are renewed");
  o.table("ping_filter", &S::ping_filter, "averaging and forgetting of what was heard");
  o.table("guidance", &S::guidance, "steering to the target, and drifting there");
  o.table("ping", &S::ping, "the acoustic channel");
  o.choice("current", &S::current, "the motion of the water");
  o.table("energy", &S::energy, "what the consumers draw");
  o.table("faults", &S::faults, "what goes wrong on purpose");
  o.table("quality", &S::quality, "how the formation quality is measured");
}

std::int64_t ticks_of(double period_s, double tick_s, const std::string& key) {
  const double ratio = period_s / tick_s;
  const double whole = std::round(ratio);
  if (whole < 1.0 || std::abs(ratio - whole) > 1e-9 * whole) {
    throw InputError(key + " is " + shortest(period_s) +
                     " s; it must be a multiple of trial.tick_s = " + shortest(tick_s) + " s");
  }
  return static_cast<std::int64_t>(whole);
}

namespace {

void require_ticks(const Scenario& s) {
  const double tick = s.trial.tick_s;
  ticks_of(s.trial.duration_s, tick, "trial.duration_s");
  ticks_of(s.guidance.period_s, tick, "guidance.period_s");
  if (s.planner.update == PlannerOptions::Update::tick) {
    ticks_of(s.planner.period_s, tick, "planner.period_s");
  }
  if (s.trial.record_every_s > 0.0) ticks_of(s.trial.record_every_s, tick, "trial.record_every_s");
  if (s.quality.every_s > 0.0) ticks_of(s.quality.every_s, tick, "quality.every_s");
  if (s.faults.node_loss.count > 0) {
    ticks_of(s.faults.node_loss.every_s, tick, "faults.node_loss.every_s");
  }
  if (s.ping.period_s < tick) {
    throw InputError("ping.period_s is " + shortest(s.ping.period_s) +
                     " s; it must be at least trial.tick_s = " + shortest(tick) + " s");
  }
  if (const auto refused = s.swarm.vehicle.make()->refuses_tick(tick)) throw InputError(*refused);
}

}  // namespace

Scenario read_scenario(const Setting& root) {
  Scenario scenario;
  read(scenario, root, "");
  try {
    require_ticks(scenario);
    const auto behaviour = scenario.behaviour.make();
    if (behaviour->needs_ids() && !scenario.ping.identified) {
      throw InputError("behaviour " + scenario.behaviour.kind() +
                       " needs to know who pings; set ping.identified = true");
    }
    if (!scenario.ping.identified && scenario.ping_filter.rest_s >= scenario.ping.period_s) {
      throw InputError(
          "ping_filter.rest_s must be shorter than ping.period_s, or every ping "
          "without id would begin a new track");
    }
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::string prefix = Origin{root.origin.file, 0}.prefix();
    throw InputError(message.starts_with(prefix) ? message : prefix + message);
  }
  return scenario;
}

std::filesystem::path find_scenario(const std::string& name_or_path) {
  namespace fs = std::filesystem;
  if (fs::exists(name_or_path)) return name_or_path;
  const fs::path in_library = library_path() / (name_or_path + ".toml");
  if (fs::exists(in_library)) return in_library;
  throw InputError(name_or_path +
                   ": there is no such file, and no scenario of that name in the "
                   "library" +
                   suggestion(name_or_path, library_scenarios()));
}

Setting resolved_scenario(const Scenario& scenario) {
  return write_options(schema_of<Scenario>(), &scenario);
}

}  // namespace shoal::scenarios
