// make_current SOURCE OUTPUT.nc
//
// Turns a mean flow and a few drifting eddies, described in a small TOML file, into a CF netCDF
// file on axes in metres from the origin. scenarios/currents/redsea_like.eddies is such a file, and
// says what every line means.

#include <fmt/format.h>
#include <netcdf.h>

#include <toml++/toml.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Axis {
  double first = 0.0, last = 0.0, step = 0.0;

  std::size_t size() const {
    return static_cast<std::size_t>(std::lround((last - first) / step)) + 1;
  }
  std::vector<double> values() const {
    std::vector<double> values;
    for (std::size_t i = 0; i < size(); ++i)
      values.push_back(first + static_cast<double>(i) * step);
    return values;
  }
};

struct Eddy {
  double x_m, y_m;                  ///< centre at second 0
  double radius_m;                  ///< where the speed peaks
  double speed_m_s;                 ///< there, counter-clockwise
  double drift_u_m_s, drift_v_m_s;  ///< of the centre
  double swing, period_s, phase;    ///< strength x (1 + swing sin(2 pi t / period + phase))
};

struct Field {
  std::string title, time_zero;
  Axis x_m, y_m, time_s;
  double mean_u_m_s, mean_v_m_s;
  std::vector<Eddy> eddies;
};

struct Velocity {
  double u, v;
};

/// The stream function of an eddy is a Gaussian, so that the flow is free of divergence and its
/// speed around the centre is speed (r / radius) exp((1 - r^2 / radius^2) / 2).
Velocity velocity_at(const Field& field, double x_m, double y_m, double time_s) {
  Velocity sum{field.mean_u_m_s, field.mean_v_m_s};
  for (const Eddy& eddy : field.eddies) {
    const double dx = (x_m - eddy.x_m - eddy.drift_u_m_s * time_s) / eddy.radius_m;
    const double dy = (y_m - eddy.y_m - eddy.drift_v_m_s * time_s) / eddy.radius_m;
    const double phase = 2.0 * std::numbers::pi * time_s / eddy.period_s + eddy.phase;
    const double strength = eddy.speed_m_s * (1.0 + eddy.swing * std::sin(phase)) *
                            std::exp(0.5 * (1.0 - dx * dx - dy * dy));
    sum.u -= strength * dy;
    sum.v += strength * dx;
  }
  return sum;
}

double number(const toml::table& table, const char* key) {
  const auto value = table[key].value<double>();
  if (!value) {
    throw std::runtime_error(
        fmt::format("line {}: a number \"{}\" is missing", table.source().begin.line, key));
  }
  return *value;
}

const toml::table& table_of(const toml::table& parent, const char* key) {
  const toml::table* table = parent[key].as_table();
  if (!table) throw std::runtime_error(fmt::format("the table [{}] is missing", key));
  return *table;
}

Axis axis_of(const toml::table& table) {
  const Axis axis{number(table, "first"), number(table, "last"), number(table, "step")};
  const double steps = (axis.last - axis.first) / axis.step;
  if (!(axis.step > 0.0) || steps < 1.0 || std::abs(steps - std::round(steps)) > 1e-9) {
    throw std::runtime_error(
        fmt::format("line {}: first, last and step make no axis", table.source().begin.line));
  }
  return axis;
}

Field read_field(const std::string& path) {
  const toml::table source = toml::parse_file(path);
  const toml::table& grid = table_of(source, "grid");
  const toml::table& mean = table_of(source, "mean");
  Field field{.title = source["title"].value_or(std::string()),
              .time_zero = source["time_zero"].value_or(std::string()),
              .x_m = axis_of(table_of(grid, "x_m")),
              .y_m = axis_of(table_of(grid, "y_m")),
              .time_s = axis_of(table_of(grid, "time_s")),
              .mean_u_m_s = number(mean, "u_m_s"),
              .mean_v_m_s = number(mean, "v_m_s"),
              .eddies = {}};
  if (field.title.empty() || field.time_zero.empty()) {
    throw std::runtime_error("title and time_zero are missing");
  }
  const toml::array* eddies = source["eddy"].as_array();
  for (std::size_t i = 0; eddies && i < eddies->size(); ++i) {
    const toml::table* e = eddies->get(i)->as_table();
    if (!e) throw std::runtime_error("an eddy is not a table");
    field.eddies.push_back({number(*e, "x_m"), number(*e, "y_m"), number(*e, "radius_m"),
                            number(*e, "speed_m_s"), number(*e, "drift_u_m_s"),
                            number(*e, "drift_v_m_s"), number(*e, "swing"), number(*e, "period_s"),
                            number(*e, "phase")});
    if (!(field.eddies.back().radius_m > 0.0) || !(field.eddies.back().period_s > 0.0)) {
      throw std::runtime_error(
          fmt::format("line {}: radius_m and period_s must be positive", e->source().begin.line));
    }
  }
  return field;
}

void require(int status) {
  if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
}

/// A netCDF file being written; closed on the way out.
class Writer {
 public:
  explicit Writer(const std::string& path) {
    require(nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &id_));
  }
  ~Writer() { nc_close(id_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  int dimension(const char* name, std::size_t length) {
    int dimension = 0;
    require(nc_def_dim(id_, name, length, &dimension));
    return dimension;
  }

  int variable(const char* name, nc_type type, const std::vector<int>& dimensions,
               const std::vector<std::pair<const char*, std::string>>& attributes) {
    int variable = 0;
    require(nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(),
                       &variable));
    for (const auto& [attribute, text] : attributes) this->text(variable, attribute, text);
    return variable;
  }

  void text(int variable, const char* attribute, const std::string& text) {
    require(nc_put_att_text(id_, variable, attribute, text.size(), text.c_str()));
  }
  void number(int variable, const char* attribute, double value) {
    require(nc_put_att_double(id_, variable, attribute, NC_DOUBLE, 1, &value));
  }
  void fill(int variable, std::int16_t value) {
    require(nc_put_att_short(id_, variable, "_FillValue", NC_SHORT, 1, &value));
  }
  void end_definitions() { require(nc_enddef(id_)); }
  void put(int variable, const std::vector<double>& values) {
    require(nc_put_var_double(id_, variable, values.data()));
  }
  void put(int variable, const std::vector<std::int16_t>& values) {
    require(nc_put_var_short(id_, variable, values.data()));
  }
  void flush() { require(nc_sync(id_)); }

 private:
  int id_ = -1;
};

constexpr double packed_unit_m_s = 1e-4;

std::int16_t packed(double velocity_m_s) {
  const double stored = std::round(velocity_m_s / packed_unit_m_s);
  if (!(std::abs(stored) < 32767.0)) throw std::runtime_error("a velocity exceeds 3.2 m/s");
  return static_cast<std::int16_t>(stored);
}

void write(const Field& field, const std::string& path) {
  const std::vector<double> x_m = field.x_m.values();
  const std::vector<double> y_m = field.y_m.values();
  const std::vector<double> time = field.time_s.values();
  std::vector<std::int16_t> u, v;
  for (const double t : time) {
    for (const double y : y_m) {
      for (const double x : x_m) {
        const Velocity velocity = velocity_at(field, x, y, t);
        u.push_back(packed(velocity.u));
        v.push_back(packed(velocity.v));
      }
    }
  }

  Writer file(path);
  const int t = file.dimension("time", time.size());
  const int y = file.dimension("y", y_m.size());
  const int x = file.dimension("x", x_m.size());
  const int time_variable = file.variable("time", NC_DOUBLE, {t},
                                          {{"standard_name", "time"},
                                           {"units", "seconds since " + field.time_zero},
                                           {"calendar", "standard"},
                                           {"axis", "T"}});
  const int y_variable =
      file.variable("y", NC_DOUBLE, {y},
                    {{"standard_name", "projection_y_coordinate"}, {"units", "m"}, {"axis", "Y"}});
  const int x_variable =
      file.variable("x", NC_DOUBLE, {x},
                    {{"standard_name", "projection_x_coordinate"}, {"units", "m"}, {"axis", "X"}});
  const int u_variable =
      file.variable("u", NC_SHORT, {t, y, x},
                    {{"standard_name", "eastward_sea_water_velocity"}, {"units", "m s-1"}});
  const int v_variable =
      file.variable("v", NC_SHORT, {t, y, x},
                    {{"standard_name", "northward_sea_water_velocity"}, {"units", "m s-1"}});
  for (const int variable : {u_variable, v_variable}) {
    file.number(variable, "scale_factor", packed_unit_m_s);
    file.fill(variable, INT16_MIN);
  }
  file.text(NC_GLOBAL, "Conventions", "CF-1.8");
  file.text(NC_GLOBAL, "title", field.title);
  file.text(NC_GLOBAL, "source", "synthetic: a mean flow and drifting eddies, made with shoal");
  file.end_definitions();
  file.put(time_variable, time);
  file.put(y_variable, y_m);
  file.put(x_variable, x_m);
  file.put(u_variable, u);
  file.put(v_variable, v);
  file.flush();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: make_current SOURCE OUTPUT.nc\n");
    return 2;
  }
  const std::string source = argv[1], output = argv[2];
  const std::string unfinished = output + ".part";
  try {
    write(read_field(source), unfinished);
    std::filesystem::rename(unfinished, output);
  } catch (const toml::parse_error& error) {
    fmt::print(stderr, "{}:{}: {}\n", source, error.source().begin.line, error.description());
    return 2;
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    fmt::print(stderr, "{}: {}\n", source, error.what());
    return 1;
  }
  return 0;
}
