#include "shoal/scenarios/trial_record.hpp"

#include <cmath>
#include <limits>

#include "shoal/core/angles.hpp"
#include "shoal/formations/obstacles/outline.hpp"
#include "shoal/scenarios/mission_time.hpp"

namespace shoal::scenarios {
namespace {

/// A recorded variable: declared here and nowhere else.
struct Variable {
  const char* name;
  const char* unit;
  const char* meaning;
  double (*value)(const World&, std::size_t);
};

Eigen::Vector2d target(const World& w, std::size_t i) {
  return w.planner(i).target_from(w.swarm().own_position(i));
}

const Variable variables[] = {
    {"x", "m", "east of the origin",
     [](const World& w, std::size_t i) { return w.swarm().x_m[i]; }},
    {"y", "m", "north of the origin",
     [](const World& w, std::size_t i) { return w.swarm().y_m[i]; }},
    {"depth", "m", "depth", [](const World& w, std::size_t i) { return w.swarm().depth_m[i]; }},
    {"heading", "degree", "compass heading",
     [](const World& w, std::size_t i) { return to_compass_deg(w.swarm().heading_rad[i]); }},
    {"speed", "m s-1", "forward speed through water",
     [](const World& w, std::size_t i) { return w.swarm().speed_m_s[i]; }},
    {"thrusting", "1", "1 under a command to move, 0 drifting",
     [](const World& w, std::size_t i) { return w.command(i).thrust ? 1.0 : 0.0; }},
    {"target_x", "m", "target relative to where the vehicle believes to be, east",
     [](const World& w, std::size_t i) { return target(w, i).x(); }},
    {"target_y", "m", "target relative to where the vehicle believes to be, north",
     [](const World& w, std::size_t i) { return target(w, i).y(); }},
    {"target_reason", "1", "why the target is what it is; see flag_meanings",
     [](const World& w, std::size_t i) {
       return static_cast<double>(w.planner(i).last_target().reason);
     }},
    {"energy_propulsion", "W h", "electrical energy spent on thrust and turning",
     [](const World& w, std::size_t i) { return w.propulsion_wh(i); }},
    {"energy_hotel", "W h", "electrical energy of the hotel load",
     [](const World& w, std::size_t i) { return w.hotel_wh(i); }},
    {"energy_comms", "W h", "electrical energy of the own pings",
     [](const World& w, std::size_t i) { return w.comms_wh(i); }},
    {"thrust_time", "s", "time under a command to move",
     [](const World& w, std::size_t i) { return w.logbook(i).thrusting_s; }},
    {"distance", "m", "distance over ground",
     [](const World& w, std::size_t i) { return w.logbook(i).distance_m; }},
    {"thrust_distance", "m", "distance over ground while moving through the water",
     [](const World& w, std::size_t i) { return w.logbook(i).thrust_distance_m; }},
};

struct Attribute {
  const char* name;
  const char* value;
};

/// What makes positions the coordinates of all other variables (CF-1.8, sec. 5 and 9.5).
std::vector<Attribute> attributes_of(const Variable& variable) {
  const std::string_view name = variable.name;
  if (name == "x") return {{"axis", "X"}};
  if (name == "y") return {{"axis", "Y"}};
  if (name == "depth") return {{"standard_name", "depth"}, {"positive", "down"}, {"axis", "Z"}};
  return {{"coordinates", "time x y depth vehicle"}};
}

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

void write_names(NetcdfOutput& file, NetcdfOutput::Variable variable, const World& world,
                 std::size_t width) {
  std::vector<char> names(world.size() * width, '\0');
  for (std::size_t i = 0; i < world.size(); ++i) {
    world.plan().name(static_cast<int>(i)).copy(&names[i * width], width);
  }
  file.put(variable, std::span<const char>(names));
}

/// The edges of obstacles, in a group of their own: they are no trajectories.
void write_obstacles(NetcdfOutput& file, const World& world) {
  std::vector<double> number, x, y;
  for (const auto& obstacle : world.obstacles()) {
    const double next = number.empty() ? 1.0 : number.back() + 1.0;
    for (const Eigen::Vector2d& corner : formations::outline(*obstacle)) {
      number.push_back(next);
      x.push_back(corner.x());
      y.push_back(corner.y());
    }
  }
  if (number.empty()) return;
  using Type = NetcdfOutput::Type;
  const NetcdfOutput::Group group = file.group(file.root(), "obstacles");
  const auto corner = file.dimension(group, "corner", number.size());
  const auto put = [&](const char* name, const char* unit, const char* meaning,
                       const std::vector<double>& values) {
    file.put(file.variable(group, name, Type::double_float, {corner}, unit, meaning), values);
  };
  put("obstacle", "1", "which obstacle the corner belongs to, in the order of the scenario",
      number);
  put("x", "m", "east of the origin, of the corners of its edge as a polygon", x);
  put("y", "m", "north of the origin", y);
}

std::string reason_meanings() {
  std::string meanings;
  for (int r = 0; r < formations::reason_count; ++r) {
    meanings += (r ? " " : "") + std::string(name_of(static_cast<formations::Reason>(r)));
  }
  return meanings;
}

}  // namespace

double TrialRecord::numbers_of_each_vehicle() {
  return static_cast<double>(std::size(variables));
}

void TrialRecord::observe(const World& world) {
  columns_.resize(std::size(variables));
  time_s_.push_back(world.time_s());
  for (std::size_t v = 0; v < std::size(variables); ++v) {
    for (std::size_t i = 0; i < world.size(); ++i) {
      columns_[v].push_back(world.lost(i) ? missing
                                          : static_cast<float>(variables[v].value(world, i)));
    }
  }
}

void TrialRecord::write(const std::filesystem::path& path, const World& world,
                        const FileAttributes& attributes) const {
  using Type = NetcdfOutput::Type;
  NetcdfOutput file(path);
  const NetcdfOutput::Group root = file.root();
  file.text(root, "Conventions", "CF-1.8");
  file.text(root, "featureType", "trajectory");
  for (const auto& [name, value] : attributes) file.text(root, name, value);

  std::size_t width = 1;
  for (const std::string& name : world.plan().names()) width = std::max(width, name.size());
  const auto vehicle_dim = file.dimension(root, "vehicle", world.size());
  const auto width_dim = file.dimension(root, "name_length", width);
  const auto time_dim = file.dimension(root, "time", time_s_.size());

  const auto vehicle =
      file.variable(root, "vehicle", Type::character, {vehicle_dim, width_dim}, "", "vehicle");
  file.text(vehicle, "cf_role", "trajectory_id");
  file.text(vehicle, "_Encoding", "utf-8");
  const auto time = mission_time(file, "time", time_dim, world.scenario().trial.start);

  std::vector<NetcdfOutput::Variable> recorded;
  for (const Variable& v : variables) {
    const auto made =
        file.variable(root, v.name, Type::single_float, {vehicle_dim, time_dim}, v.unit, v.meaning);
    file.fill_with_nan(made);
    file.compress(made);
    for (const Attribute& attribute : attributes_of(v)) {
      file.text(made, attribute.name, attribute.value);
    }
    if (std::string_view(v.name) == "target_reason") {
      file.text(made, "flag_meanings", reason_meanings());
      std::vector<double> flags;
      for (int r = 0; r < formations::reason_count; ++r) flags.push_back(r);
      file.numbers(made, "flag_values", flags);
    }
    recorded.push_back(made);
  }
  write_names(file, vehicle, world, width);
  file.put(time, time_s_);
  const std::size_t n = world.size();
  std::vector<float> transposed(n * time_s_.size());
  for (std::size_t v = 0; v < recorded.size(); ++v) {
    if (time_s_.empty()) break;
    for (std::size_t t = 0; t < time_s_.size(); ++t) {
      for (std::size_t i = 0; i < n; ++i) {
        transposed[i * time_s_.size() + t] = columns_[v][t * n + i];
      }
    }
    file.put(recorded[v], std::span<const float>(transposed));
  }
  write_obstacles(file, world);
  file.finish();
}

}  // namespace shoal::scenarios
