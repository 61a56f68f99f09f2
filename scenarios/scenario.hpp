#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shoal/core/registry.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/guidance.hpp"
#include "shoal/formations/ping_filter.hpp"
#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/acoustics/channel.hpp"
#include "shoal/scenarios/currents/current.hpp"
#include "shoal/scenarios/energy.hpp"
#include "shoal/scenarios/faults/fault.hpp"
#include "shoal/scenarios/obstacles.hpp"
#include "shoal/scenarios/starts/start.hpp"
#include "shoal/scenarios/stops/stop_rule.hpp"
#include "shoal/scenarios/vehicles/swarm.hpp"

namespace shoal::scenarios {

struct TrialOptions {
  double duration_s = 18000.0;
  std::int64_t seed = 1;
  double record_every_s = 5.0;
  double tick_s = 0.25;
  std::string start = "2000-01-01T00:00:00Z";
  bool time_solves = false;

  static void declare(Options<TrialOptions>& o);
};

struct SwarmOptions {
  Choice<VehicleType> vehicle{"drifter"};
  Choice<StartSource> start{"box"};

  static void declare(Options<SwarmOptions>& o);
};

/// The instants at which targets are renewed.
struct PlannerOptions {
  enum class Update { ping, tick };

  Update update = Update::ping;
  double period_s = 0.25;

  static void declare(Options<PlannerOptions>& o);
};

/// The place that all vehicles are led to, by behaviours that lead to one.
struct Waypoint {
  double x_m = std::numeric_limits<double>::quiet_NaN();  ///< to be set, and so is y_m
  double y_m = std::numeric_limits<double>::quiet_NaN();
  double radius_m = 60.0;
  bool ends_trial = false;

  static void declare(Options<Waypoint>& o);
  std::optional<std::string> complaint() const;
  Eigen::Vector2d place() const { return {x_m, y_m}; }
};

/// How the formation quality is measured: Rypkema 2015, sec. 4.3, Table 4.3; or as the least of all
/// rigid motions, which his recipes miss where vehicles are lost.
struct QualityOptions {
  enum class Alignment { rigid, centroid, nearest_point };

  double every_s = 30.0;
  std::int64_t layers = 1;
  Alignment alignment = Alignment::rigid;
  double tolerance_m = 0.01;
  std::int64_t budget = 400'000;
  double delta_theta_deg = 10.0;

  static void declare(Options<QualityOptions>& o);
};

/// One reproducible experiment: everything that a trial depends on.
struct Scenario {
  TrialOptions trial;
  Choice<StopRule> stop{"duration"};
  SwarmOptions swarm;
  Choice<formations::PlanSource> plan{"square"};
  Choice<formations::Behaviour> behaviour{"rigid_registration"};
  PlannerOptions planner;
  formations::PingFilterOptions ping_filter;
  Choice<formations::Guidance> guidance{"drift"};
  std::optional<Waypoint> waypoint;
  PingOptions ping;
  Choice<Current> current{"none"};
  std::vector<ObstacleOptions> obstacles;
  Energy energy;
  Choice<Fault> faults{"node_loss"};
  QualityOptions quality;
  MemberOptions measures;

  static void declare(Options<Scenario>& o);
};

/// Reads a scenario and checks all that can be checked without running it. Throws InputError.
Scenario read_scenario(const Setting& root);

/// The file of a scenario given by path, or by its name in the library. Throws InputError.
std::filesystem::path find_scenario(const std::string& name_or_path);

/// The whole scenario, also what was not set.
Setting resolved_scenario(const Scenario& scenario);

/// How many ticks a period has. Throws InputError, naming `key`, unless it is a whole number.
std::int64_t ticks_of(double period_s, double tick_s, const std::string& key);

}  // namespace shoal::scenarios
