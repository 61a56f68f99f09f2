#include "shoal/scenarios/trial_record.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "shoal/core/angles.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/currents/netcdf_file.hpp"
#include "shoal/scenarios/currents/netcdf_time.hpp"

namespace shoal::scenarios {
namespace {

/// A recorded variable: declared here and nowhere else.
struct Variable {
  const char* name;
  const char* unit;
  const char* meaning;
  double (*value)(const World&, std::size_t);
};

Eigen::Vector2d position(const World& w, std::size_t i) {
  return {w.swarm().x_m[i], w.swarm().y_m[i]};
}

Eigen::Vector2d target(const World& w, std::size_t i) {
  return w.planner(i).target_from(position(w, i));
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
    {"target_x", "m", "target relative to the vehicle, east",
     [](const World& w, std::size_t i) { return target(w, i).x(); }},
    {"target_y", "m", "target relative to the vehicle, north",
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

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// A netCDF file made in memory and written as a whole: HDF5 does not survive a full disk.
class File {
 public:
  explicit File(const std::filesystem::path& path) : path_(path) {
    constexpr std::size_t initial_bytes = 1 << 20;
    check(nc_create_mem(path_.c_str(), NC_NETCDF4, initial_bytes, &id_));
    open_ = true;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (open_) nc_abort(id_);
  }

  void check(int code) const {
    if (code == NC_NOERR) return;
    throw SystemError("cannot make " + path_.string() + ": " + nc_strerror(code));
  }

  void text(int variable, const char* name, const std::string& value) const {
    check(nc_put_att_text(id_, variable, name, value.size(), value.c_str()));
  }

  int dimension(const std::string& name, std::size_t size) const {
    int dimension = 0;
    check(nc_def_dim(id_, name.c_str(), size, &dimension));
    return dimension;
  }

  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions,
               const std::string& unit, const std::string& meaning) const {
    int variable = 0;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()),
                     dimensions.data(), &variable));
    if (!unit.empty()) text(variable, "units", unit);
    text(variable, "long_name", meaning);
    return variable;
  }

  void finish() {
    open_ = false;
    NC_memio content{};
    check(nc_close_memio(id_, &content));
    const std::unique_ptr<void, decltype(&std::free)> owned(content.memory, &std::free);
    write_whole_file(path_, {static_cast<const char*>(content.memory), content.size});
  }

  int id() const { return id_; }

 private:
  std::filesystem::path path_;
  int id_ = 0;
  bool open_ = false;
};

void write_names(const File& file, int variable, const World& world, std::size_t width) {
  std::vector<char> names(world.size() * width, '\0');
  for (std::size_t i = 0; i < world.size(); ++i) {
    world.plan().name(static_cast<int>(i)).copy(&names[i * width], width);
  }
  file.check(nc_put_var_text(file.id(), variable, names.data()));
}

std::string reason_meanings() {
  std::string meanings;
  for (int r = 0; r < formations::reason_count; ++r) {
    meanings += (r ? " " : "") + std::string(name_of(static_cast<formations::Reason>(r)));
  }
  return meanings;
}

}  // namespace

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
                        const std::vector<Series>& series,
                        const std::vector<std::pair<std::string, std::string>>& attributes) const {
  const std::lock_guard lock(netcdf_mutex());
  File file(path);
  file.text(NC_GLOBAL, "Conventions", "CF-1.8");
  file.text(NC_GLOBAL, "featureType", "trajectory");
  for (const auto& [name, value] : attributes) file.text(NC_GLOBAL, name.c_str(), value);

  std::size_t width = 1;
  for (const std::string& name : world.plan().names()) width = std::max(width, name.size());
  const std::string since =
      "seconds since " +
      iso_text(parse_instant(world.scenario().trial.start, Calendar::standard), Calendar::standard);
  const int vehicle_dim = file.dimension("vehicle", world.size());
  const int width_dim = file.dimension("name_length", width);
  const int time_dim = file.dimension("time", time_s_.size());

  const int vehicle = file.variable("vehicle", NC_CHAR, {vehicle_dim, width_dim}, "", "vehicle");
  file.text(vehicle, "cf_role", "trajectory_id");
  file.text(vehicle, "_Encoding", "utf-8");
  const auto time_axis = [&](const std::string& name, int dimension) {
    const int axis = file.variable(name, NC_DOUBLE, {dimension}, since, "time since mission start");
    file.text(axis, "standard_name", "time");
    file.text(axis, "calendar", "standard");
    return axis;
  };
  const int time = time_axis("time", time_dim);

  std::vector<int> ids;
  for (const Variable& v : variables) {
    const int id = file.variable(v.name, NC_FLOAT, {vehicle_dim, time_dim}, v.unit, v.meaning);
    file.check(nc_def_var_fill(file.id(), id, NC_FILL, &missing));
    file.check(nc_def_var_deflate(file.id(), id, 1, 1, 1));
    if (std::string_view(v.name) == "target_reason") {
      file.text(id, "flag_meanings", reason_meanings());
      std::vector<float> flags;
      for (int r = 0; r < formations::reason_count; ++r) flags.push_back(static_cast<float>(r));
      file.check(
          nc_put_att_float(file.id(), id, "flag_values", NC_FLOAT, flags.size(), flags.data()));
    }
    ids.push_back(id);
  }
  struct Written {
    const Series& series;
    int axis, values;
  };
  std::vector<Written> written;
  for (const Series& s : series) {
    if (s.time_s.empty()) continue;  // an axis of no length would be one without end
    const std::string axis_name = s.name + "_time";
    const int dimension = file.dimension(axis_name, s.time_s.size());
    const int axis = time_axis(axis_name, dimension);
    const int values = file.variable(s.name, NC_DOUBLE, {dimension}, s.unit, s.meaning);
    written.push_back({s, axis, values});
  }
  file.check(nc_enddef(file.id()));

  write_names(file, vehicle, world, width);
  file.check(nc_put_var_double(file.id(), time, time_s_.data()));
  const std::size_t n = world.size();
  std::vector<float> transposed(n * time_s_.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (time_s_.empty()) break;
    for (std::size_t t = 0; t < time_s_.size(); ++t) {
      for (std::size_t i = 0; i < n; ++i) {
        transposed[i * time_s_.size() + t] = columns_[v][t * n + i];
      }
    }
    file.check(nc_put_var_float(file.id(), ids[v], transposed.data()));
  }
  for (const auto& [s, axis, values] : written) {
    file.check(nc_put_var_double(file.id(), axis, s.time_s.data()));
    file.check(nc_put_var_double(file.id(), values, s.values.data()));
  }
  file.finish();
}

}  // namespace shoal::scenarios
