#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "shoal/scenarios/currents/current.hpp"
#include "shoal/scenarios/currents/netcdf_axis.hpp"
#include "shoal/scenarios/currents/netcdf_frame.hpp"
#include "shoal/scenarios/currents/netcdf_report.hpp"
#include "tests/support/netcdf_writer.hpp"
#include "tests/support/shared_data.hpp"

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using tests::NetcdfWriter;
using Values = std::vector<double>;
using Changes = std::vector<std::pair<std::string, Setting>>;

constexpr double float_rounding = 3e-8;  // of velocities below 1 m/s, kept in single precision

template <class T>
Setting plain(T value) {
  Setting setting;
  setting.value = std::move(value);
  return setting;
}

Setting origin_at(double longitude, double latitude) {
  return plain(Setting::List{plain(Setting::List{plain(longitude), plain(latitude)})});
}

Vector2d linear(double t, double, double x, double y) {
  return {0.05 + 1e-4 * x - 2e-4 * y + 3e-5 * t, -0.1 + 2e-4 * x + 1e-4 * y};
}

/// A file of currents, on projected axes unless told otherwise; every part can be set.
struct File {
  Values x{0, 100, 200}, y{0, 100, 200, 300}, time{0, 600, 1200}, depth;
  std::string x_units = "m", y_units = "m", x_name = "projection_x_coordinate",
              y_name = "projection_y_coordinate";
  std::string time_units = "seconds since 2014-12-01 00:00:00", calendar;
  std::string positive = "down", depth_units = "m";
  std::string u_name = "eastward_sea_water_velocity", v_name = "northward_sea_water_velocity";
  std::string units = "m s-1";
  nc_type type = NC_DOUBLE;
  double scale = 1.0, offset = 0.0;
  /// Velocities in the file's units, at time, depth, x and y of the axes.
  std::function<Vector2d(double, double, double, double)> velocity = linear;
  /// More attributes of both velocities, and more variables.
  std::function<void(NetcdfWriter&)> attributes = [](NetcdfWriter&) {};
  std::function<void(NetcdfWriter&)> variables = [](NetcdfWriter&) {};

  static File lon_lat(Values longitude, Values latitude) {
    File file;
    file.x = std::move(longitude);
    file.y = std::move(latitude);
    file.x_units = "degrees_east";
    file.y_units = "degrees_north";
    file.x_name = "longitude";
    file.y_name = "latitude";
    file.velocity = [](double, double, double, double) { return Vector2d(0.1, 0.2); };
    return file;
  }

  fs::path write(const std::string& name, int format = NC_64BIT_OFFSET) const;
};

/// A folder of this process alone, gone when it ends.
struct Scratch {
  fs::path folder = fs::path(testing::TempDir()) / ("shoal_netcdf_" + std::to_string(getpid()));
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

fs::path scratch(const std::string& name) {
  static const Scratch scratch;
  const fs::path folder =
      scratch.folder / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(folder);
  return folder / name;
}

fs::path File::write(const std::string& name, int format) const {
  const fs::path path = scratch(name);
  NetcdfWriter w(path, format);
  std::vector<std::string> dimensions;
  const auto axis = [&](const std::string& dimension, const Values& values) -> NetcdfWriter& {
    dimensions.push_back(dimension);
    return w.dimension(dimension, values.size())
        .variable(dimension, NC_DOUBLE, {dimension}, values);
  };
  if (!time.empty()) {
    axis("time", time).text("units", time_units);
    if (!calendar.empty()) w.text("calendar", calendar);
  }
  if (!depth.empty()) {
    axis("depth", depth).text("units", depth_units);
    if (!positive.empty()) w.text("positive", positive);
  }
  axis("y", y).text("standard_name", y_name);
  if (!y_units.empty()) w.text("units", y_units);
  axis("x", x).text("standard_name", x_name);
  if (!x_units.empty()) w.text("units", x_units);
  Values u, v;
  for (const double t : time.empty() ? Values{0.0} : time) {
    for (const double z : depth.empty() ? Values{0.0} : depth) {
      for (const double yy : y) {
        for (const double xx : x) {
          const Vector2d value = velocity(t, z, xx, yy);
          const bool integer = type != NC_FLOAT && type != NC_DOUBLE;
          const auto stored = [&](double q) {
            const double packed = (q - offset) / scale;
            return integer ? std::round(packed) : packed;
          };
          u.push_back(stored(value.x()));
          v.push_back(stored(value.y()));
        }
      }
    }
  }
  for (const bool first : {true, false}) {
    w.variable(first ? "u" : "v", type, dimensions, first ? u : v);
    if (!u_name.empty()) w.text("standard_name", first ? u_name : v_name);
    if (!units.empty()) w.text("units", units);
    if (scale != 1.0) w.number("scale_factor", NC_DOUBLE, {scale});
    if (offset != 0.0) w.number("add_offset", NC_DOUBLE, {offset});
    attributes(w);
  }
  variables(w);
  w.finish();
  return path;
}

std::unique_ptr<Current> open(const fs::path& path, const Changes& options = {}) {
  Setting table;
  table.at_or_new("file").value = path.string();
  for (const auto& [name, value] : options) table.at_or_new(name) = value;
  return Registry<Current>::instance().make("netcdf", table, "current.netcdf");
}

Vector2d at(const Current& water, double time, double x, double y) {
  Vector2d velocity(-99.0, -99.0);
  water.sample(time, {&x, 1}, {&y, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  return velocity;
}

/// The message of the InputError that this throws, "" if it throws none.
std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const fs::path& path, const Changes& options = {}) {
  return complaint([&] { open(path, options); });
}

#define EXPECT_SAYS(message, part) \
  EXPECT_NE(std::string(message).find(part), std::string::npos) << (message)

const Setting clamp = plain(std::string("clamp"));

// --- interpolation ---------------------------------------------------------------------------

TEST(NetcdfCurrent, IsExactForFieldsLinearInSpaceAndTime) {
  const File file;
  const auto water = open(file.write("linear.nc"));
  EXPECT_TRUE(rc::check("between the nodes", [&] {
    const double x = *rc::gen::inRange(0, 200000) / 1000.0;
    const double y = *rc::gen::inRange(0, 300000) / 1000.0;
    const double t = *rc::gen::inRange(0, 1200000) / 1000.0;
    RC_ASSERT((at(*water, t, x, y) - file.velocity(t, 0, x, y)).norm() < float_rounding);
  }));
}

TEST(NetcdfCurrent, IsExactOnAxesThatAreNotEquidistant) {
  File file;
  file.x = {-500, -490, -200, 0, 1000};
  file.y = {0, 1, 3, 300};
  file.time = {0, 10, 1000};
  file.velocity = [](double t, double, double x, double y) {
    return Vector2d(1e-4 * x + 2e-4 * y, 1e-4 * t);
  };
  const auto water = open(file.write("uneven.nc"));
  EXPECT_TRUE(rc::check("between the nodes", [&] {
    const double x = *rc::gen::inRange(-500000, 1000000) / 1000.0;
    const double y = *rc::gen::inRange(0, 300000) / 1000.0;
    const double t = *rc::gen::inRange(0, 1000000) / 1000.0;
    RC_ASSERT((at(*water, t, x, y) - file.velocity(t, 0, x, y)).norm() < float_rounding);
  }));
}

TEST(NetcdfCurrent, ReachesTheLastNodeOfEveryAxis) {
  const File file;
  const auto water = open(file.write("edges.nc"));
  EXPECT_LT((at(*water, 1200, 200, 300) - file.velocity(1200, 0, 200, 300)).norm(), float_rounding);
  EXPECT_NO_THROW(water->require_duration(1200.0));
}

TEST(NetcdfCurrent, ReadsDescendingAxes) {
  File file;
  file.x = {200, 100, 0};
  file.y = {300, 200, 100, 0};
  const auto water = open(file.write("descending.nc"));
  EXPECT_LT((at(*water, 300, 30, 170) - file.velocity(300, 0, 30, 170)).norm(), float_rounding);
}

TEST(NetcdfCurrent, IsSteadyWithoutATimeAxis) {
  File file;
  file.time.clear();
  const auto water = open(file.write("steady.nc"));
  EXPECT_EQ(at(*water, 0, 30, 40), at(*water, 1e7, 30, 40));
  EXPECT_NO_THROW(water->require_duration(1e9));
  EXPECT_SAYS(refusal(scratch("steady.nc"), {{"time_offset_s", plain(5.0)}}), "no time axis");
}

TEST(NetcdfCurrent, GivesTheSameBitsForOneOrManyPositions) {
  const auto water = open(File{}.write("batch.nc"));
  const Values x{10, 20, 190}, y{5, 250, 130};
  Values u(3), v(3);
  water->sample(77.0, x, y, u, v);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(at(*water, 77.0, x[k], y[k]), Vector2d(u[k], v[k]));
}

// --- packing and missing values --------------------------------------------------------------

TEST(NetcdfCurrent, UnpacksScaleAndOffset) {
  for (const double scale : {1e-4, -1e-4}) {
    File file;
    file.type = NC_SHORT;
    file.scale = scale;
    file.offset = 0.1;
    file.velocity = [](double, double, double x, double y) {
      return Vector2d(1e-3 * x - 0.1, 1e-3 * y);
    };
    const auto water = open(file.write("packed.nc"));
    EXPECT_LT((at(*water, 0, 30, 170) - Vector2d(-0.07, 0.17)).norm(), float_rounding);
  }
}

/// 1 m/s everywhere but for the node (100, 100), which is missing.
File with_hole(double stored_hole) {
  File file;
  file.velocity = [stored_hole](double, double, double x, double y) {
    return x == 100 && y == 100 ? Vector2d(stored_hole, stored_hole) : Vector2d(1.0, 1.0);
  };
  return file;
}

TEST(NetcdfCurrent, NeverBleedsMissingCornersIntoTheWater) {
  for (const double hole : {-999.0, 0.0}) {
    File file = with_hole(hole);
    file.attributes = [hole](NetcdfWriter& w) { w.number("_FillValue", NC_DOUBLE, {hole}); };
    const auto water = open(file.write("hole.nc"));
    for (const double x : {10.0, 50.0, 99.0, 101.0}) {
      EXPECT_LT((at(*water, 300, x, 90) - Vector2d(1.0, 1.0)).norm(), 1e-12) << x;
    }
  }
}

TEST(NetcdfCurrent, SharesTheWeightOfAMissingCornerAmongTheWetOnes) {
  File file;
  file.velocity = [](double, double, double x, double y) {
    return x == 0 && y == 0 ? Vector2d(-9, -9) : Vector2d(x / 1000, y / 1000);
  };
  file.attributes = [](NetcdfWriter& w) { w.number("missing_value", NC_DOUBLE, {-9}); };
  const auto water = open(file.write("corner.nc"));
  // Weights 0.25 each of (0.1, 0), (0, 0.1), (0.1, 0.1), brought to a sum of one.
  EXPECT_LT((at(*water, 0, 50, 50) - Vector2d(0.2 / 3, 0.2 / 3)).norm(), float_rounding);
}

TEST(NetcdfCurrent, RecognisesFillValuesOfAnotherType) {
  // As real files have it: an int16 variable, packed, with a float32 fill value in stored units.
  File file = with_hole(-32767.0 * -1e-4 + 0.1);
  file.type = NC_SHORT;
  file.scale = -1e-4;
  file.offset = 0.1;
  file.attributes = [](NetcdfWriter& w) { w.number("_FillValue", NC_FLOAT, {-32767.0}); };
  EXPECT_LT((at(*open(file.write("a.nc")), 0, 90, 90) - Vector2d(1, 1)).norm(), float_rounding);

  // 1e20 in float32 is not 1e20 in float64.
  file = with_hole(1e20);
  file.type = NC_FLOAT;
  file.attributes = [](NetcdfWriter& w) { w.number("missing_value", NC_DOUBLE, {1e20}); };
  EXPECT_LT((at(*open(file.write("b.nc")), 0, 90, 90) - Vector2d(1, 1)).norm(), float_rounding);
}

TEST(NetcdfCurrent, TakesNanDefaultFillAndInvalidValuesForMissing) {
  EXPECT_EQ(at(*open(with_hole(NAN).write("nan.nc")), 0, 90, 90), Vector2d(1, 1));
  EXPECT_EQ(at(*open(with_hole(NC_FILL_DOUBLE).write("default.nc")), 0, 90, 90), Vector2d(1, 1));
  File file = with_hole(9.0);
  file.attributes = [](NetcdfWriter& w) { w.number("valid_range", NC_DOUBLE, {-2, 2}); };
  EXPECT_EQ(at(*open(file.write("range.nc")), 0, 90, 90), Vector2d(1, 1));
  file.attributes = [](NetcdfWriter& w) { w.number("valid_max", NC_DOUBLE, {2}); };
  EXPECT_EQ(at(*open(file.write("max.nc")), 0, 90, 90), Vector2d(1, 1));
}

TEST(NetcdfCurrent, BoundsStoredOrUnpackedValuesByTheTypeOfValidMax) {
  File file = with_hole(3.0);  // stored as 30000
  file.type = NC_SHORT;
  file.scale = 1e-4;
  file.attributes = [](NetcdfWriter& w) { w.number("valid_max", NC_SHORT, {20000}); };
  EXPECT_LT((at(*open(file.write("s.nc")), 0, 90, 90) - Vector2d(1, 1)).norm(), float_rounding);
  file.attributes = [](NetcdfWriter& w) { w.number("valid_max", NC_DOUBLE, {2.0}); };
  EXPECT_LT((at(*open(file.write("d.nc")), 0, 90, 90) - Vector2d(1, 1)).norm(), float_rounding);
}

TEST(NetcdfCurrent, RefusesFillValuesThatNobodyDeclared) {
  EXPECT_SAYS(refusal(with_hole(9999.0).write("undeclared.nc")), "_FillValue");
  EXPECT_SAYS(refusal(with_hole(INFINITY).write("infinite.nc")), "_FillValue");
}

TEST(NetcdfCurrent, TakesLandFromAMask) {
  File file = with_hole(0.0);
  file.variables = [](NetcdfWriter& w) {
    w.variable("mask", NC_BYTE, {"y", "x"}, {1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1})
        .text("standard_name", "sea_binary_mask");
  };
  EXPECT_EQ(at(*open(file.write("mask.nc")), 0, 90, 90), Vector2d(1, 1));
}

/// Wet for x < 150 only.
File with_coast() {
  File file;
  file.velocity = [](double, double, double x, double) {
    return x > 150 ? Vector2d(NAN, NAN) : Vector2d(x / 1000, 0.5);
  };
  file.x = {0, 100, 200, 300, 400};
  return file;
}

TEST(NetcdfCurrent, NamesThePlaceAndTimeOfAPositionOnLand) {
  const auto water = open(with_coast().write("coast.nc"));
  EXPECT_NO_THROW(at(*water, 60, 150, 50));
  const std::string why = complaint([&] { at(*water, 60, 310, 50); });
  EXPECT_SAYS(why,
              "coast.nc: no current at x = 310.0 m, y = 50.0 m, t = 60 s (2014-12-01T00:01:00Z)");
  EXPECT_SAYS(why, "on land");
  EXPECT_SAYS(why, "current.netcdf.outside = \"clamp\"");
}

TEST(NetcdfCurrent, ClampsLandToTheNearestWetNode) {
  const auto water = open(with_coast().write("coast.nc"), {{"outside", clamp}});
  EXPECT_LT((at(*water, 60, 310, 50) - Vector2d(0.1, 0.5)).norm(), float_rounding);
  EXPECT_LT((at(*water, 60, 5000, 50) - Vector2d(0.1, 0.5)).norm(), float_rounding);
}

TEST(NetcdfCurrent, RefusesAFileThatIsAllLand) {
  File file;
  file.velocity = [](double, double, double, double) { return Vector2d(NAN, NAN); };
  EXPECT_SAYS(refusal(file.write("land.nc")), "every value is missing");
}

// --- time ------------------------------------------------------------------------------------

TEST(NetcdfCurrent, StartsAtTheFirstTimePlusTheOffset) {
  File file;
  file.velocity = [](double t, double, double, double) { return Vector2d(1e-4 * t, 0); };
  file.time = {600, 1200, 1800};
  const auto early = open(file.write("offset.nc"));
  EXPECT_NEAR(at(*early, 0, 0, 0).x(), 0.06, float_rounding);
  const auto late = open(scratch("offset.nc"), {{"time_offset_s", plain(90.0)}});
  EXPECT_NEAR(at(*late, 30, 0, 0).x(), 0.072, float_rounding);
  const auto dated =
      open(scratch("offset.nc"), {{"start", plain(std::string("2014-12-01T00:15:00Z"))}});
  EXPECT_NEAR(at(*dated, 0, 0, 0).x(), 0.09, float_rounding);
}

TEST(NetcdfCurrent, ReadsTimeInItsUnitZoneAndCalendar) {
  struct Case {
    std::string units, calendar, start;
    double step, seconds;  ///< mission time 60 s lies this long after the first time
  };
  const Case cases[] = {
      {"minutes since 2014-12-01 02:00:00 +02:00", "", "2014-12-01T00:05:00Z", 10, 360},
      {"hours since 2012-02-28", "noleap", "2012-03-01T01:00:00Z", 24, 86400 + 3660},
      {"hours since 2012-02-28", "standard", "2012-02-29T01:00:00Z", 24, 86400 + 3660},
      {"days since 2013-02-28", "360_day", "2013-02-30T00:00:00Z", 1, 2 * 86400 + 60},
      {"days since 1900-02-28", "julian", "1900-02-29T00:00:00Z", 1, 86400 + 60},
      {"days since 1582-10-04", "gregorian", "1582-10-15T00:00:00Z", 1, 86400 + 60},
      {"weeks since 2014-12-01", "proleptic_gregorian", "2014-12-08T00:00:00Z", 1, 604800 + 60}};
  for (const Case& c : cases) {
    File file;
    file.time_units = c.units;
    file.calendar = c.calendar;
    file.time = {0, c.step, 2 * c.step, 3 * c.step};
    const double unit = parse_time_units(c.units, calendar_named(c.calendar)).seconds;
    file.velocity = [&](double t, double, double, double) {
      return Vector2d(1e-6 * unit * t, 0.0);
    };
    const auto water = open(file.write("time.nc"), {{"start", plain(c.start)}});
    EXPECT_NEAR(at(*water, 60, 0, 0).x(), 1e-6 * c.seconds, 1e-6) << c.units << " " << c.calendar;
  }
}

TEST(NetcdfCurrent, NamesTheEndOfTheFileThatAMissionPasses) {
  File file;
  file.time = {0, 9100, 18200};
  const auto water = open(file.write("currents.nc"), {{"time_offset_s", plain(120.0)}});
  const std::string expected =
      "currents.nc: no current at t = 18100 s: the file ends at 2014-12-01T05:03:20Z (18200 s "
      "minus "
      "the offset of 120 s); shorten trial.duration_s or set current.netcdf.outside = \"clamp\"";
  EXPECT_SAYS(complaint([&] { water->require_duration(18100.0); }), expected);
  EXPECT_SAYS(complaint([&] { at(*water, 18100.0, 0, 0); }), expected);
  EXPECT_NO_THROW(water->require_duration(18080.0));
  EXPECT_THROW(at(*water, NAN, 0, 0), InputError);
}

TEST(NetcdfCurrent, RefusesAMissionThatBeginsBeforeTheFile) {
  const auto water = open(File{}.write("early.nc"), {{"time_offset_s", plain(-10.0)}});
  EXPECT_SAYS(complaint([&] { water->require_duration(5.0); }),
              "begins at 2014-12-01T00:00:00Z (0 s plus the offset of 10 s)");
}

TEST(NetcdfCurrent, HoldsTheFirstAndLastTimeWhenClamped) {
  const File file;
  const auto water =
      open(file.write("clamp.nc"), {{"outside", clamp}, {"time_offset_s", plain(-100.0)}});
  EXPECT_NO_THROW(water->require_duration(1e6));
  EXPECT_LT((at(*water, 0, 50, 50) - file.velocity(0, 0, 50, 50)).norm(), float_rounding);
  EXPECT_LT((at(*water, 1e6, 50, 50) - file.velocity(1200, 0, 50, 50)).norm(), float_rounding);
}

TEST(NetcdfCurrent, LastsFromASingleTimeOnlyWhenClamped) {
  File file;
  file.time = {3600};
  EXPECT_SAYS(refusal(file.write("single.nc")), "a single time, 2014-12-01T01:00:00Z");
  EXPECT_NO_THROW(open(scratch("single.nc"), {{"outside", clamp}})->require_duration(1e6));
}

TEST(NetcdfCurrent, RefusesTimesItCannotPlace) {
  File file;
  file.calendar = "mayan";
  EXPECT_SAYS(refusal(file.write("calendar.nc")), "the calendar \"mayan\"");
  file.calendar = "";
  file.time_units = "months since 2014-12-01";
  EXPECT_SAYS(refusal(file.write("months.nc")), "months");
  file.time_units = "seconds since 2014-12-01";
  file.time = {0, 600, 600};
  EXPECT_SAYS(refusal(file.write("repeated.nc")), "does not increase");
  file.time = {0, 600};
  EXPECT_SAYS(refusal(file.write("date.nc"), {{"start", plain(std::string("tomorrow"))}}),
              "current.netcdf.start");
}

// --- depth -----------------------------------------------------------------------------------

TEST(NetcdfCurrent, InterpolatesBetweenDepthLevels) {
  for (const double sign : {1.0, -1.0}) {
    File file;
    file.depth = {0, sign * 10, sign * 30};
    file.positive = sign > 0 ? "down" : "up";
    file.velocity = [](double, double z, double, double) {
      return Vector2d(0.01 * std::abs(z), 0);
    };
    const fs::path path = file.write("depth.nc");
    EXPECT_NEAR(at(*open(path), 0, 50, 50).x(), 0.0, float_rounding);
    EXPECT_NEAR(at(*open(path, {{"depth_m", plain(10.0)}}), 0, 50, 50).x(), 0.1, float_rounding);
    EXPECT_NEAR(at(*open(path, {{"depth_m", plain(25.0)}}), 0, 50, 50).x(), 0.25, float_rounding);
    EXPECT_SAYS(refusal(path, {{"depth_m", plain(31.0)}}), "levels run from 0 to 30 m");
    const auto deep = open(path, {{"depth_m", plain(31.0)}, {"outside", clamp}});
    EXPECT_NEAR(at(*deep, 0, 50, 50).x(), 0.3, float_rounding);
  }
}

TEST(NetcdfCurrent, RefusesDepthsThatASingleLevelDoesNotHave) {
  File file;
  file.depth = {5};
  EXPECT_SAYS(refusal(file.write("level.nc")), "the only level is at 5 m");
  EXPECT_NO_THROW(open(scratch("level.nc"), {{"depth_m", plain(5.0)}}));
  file.depth.clear();
  EXPECT_SAYS(refusal(file.write("surface.nc"), {{"depth_m", plain(5.0)}}), "has no depths");
}

TEST(NetcdfCurrent, UsesTheWetLevelWhereTheOtherIsSeaFloor) {
  File file;
  file.depth = {0, 10};
  file.velocity = [](double, double z, double, double) {
    return z > 5 ? Vector2d(NAN, NAN) : Vector2d(0.25, 0.5);
  };
  const auto water = open(file.write("floor.nc"), {{"depth_m", plain(5.0)}});
  EXPECT_EQ(at(*water, 0, 50, 50), Vector2d(0.25, 0.5));
}

TEST(NetcdfCurrent, RefusesADepthAxisWithoutADirection) {
  File file;
  file.depth = {0, 10};
  file.positive = "";
  EXPECT_SAYS(refusal(file.write("which_way.nc")), "which way is positive");
}

// --- space -----------------------------------------------------------------------------------

TEST(NetcdfCurrent, NamesTheExtentThatAPositionLeaves) {
  const auto water = open(File{}.write("box.nc"));
  EXPECT_SAYS(
      complaint([&] { at(*water, 0, 201, 0); }),
      "box.nc: no current at x = 201.0 m, y = 0.0 m: the file covers x from 0.0 to 200.0 m and "
      "y from 0.0 to 300.0 m");
  EXPECT_THROW(at(*water, 0, NAN, 0), InputError);
  const auto held = open(scratch("box.nc"), {{"outside", clamp}});
  EXPECT_EQ(at(*held, 0, 500, 100), at(*held, 0, 200, 100));
  EXPECT_THROW(at(*held, 0, NAN, 0), InputError);
}

TEST(NetcdfCurrent, MovesTheOriginOnProjectedAxesInMetresOrKilometres) {
  File file;
  const auto expected = file.velocity(0, 0, 130, 170);
  const Changes origin{{"origin_x_m", plain(100.0)}, {"origin_y_m", plain(150.0)}};
  EXPECT_LT((at(*open(file.write("m.nc"), origin), 0, 30, 20) - expected).norm(), float_rounding);
  file.x_units = file.y_units = "km";
  const auto velocity = file.velocity;
  file.velocity = [=](double t, double z, double x, double y) {
    return velocity(t, z, 1000 * x, 1000 * y);
  };
  file.x = {0, 0.1, 0.2};
  file.y = {0, 0.1, 0.2, 0.3};
  EXPECT_LT((at(*open(file.write("km.nc"), origin), 0, 30, 20) - expected).norm(), float_rounding);
}

TEST(NetcdfCurrent, MeasuresLongitudeAndLatitudeInMetresFromTheOrigin) {
  // WGS84: a degree of longitude at the equator is a pi/180, a degree of latitude a(1-e2) pi/180.
  EXPECT_NEAR(metres_per_degree(0).x(), 111319.490793, 1e-5);
  EXPECT_NEAR(metres_per_degree(0).y(), 110574.275822, 1e-5);
  EXPECT_NEAR(metres_per_degree(45).x(), 78846.834, 2e-3);
  EXPECT_NEAR(metres_per_degree(45).y(), 111131.778, 2e-3);

  File file = File::lon_lat({35.40, 35.45, 35.55}, {27.30, 27.38, 27.40});
  file.velocity = [](double, double, double lon, double lat) {
    return Vector2d(lon - 35.45, lat - 27.38);
  };
  const auto water = open(file.write("lonlat.nc"), {{"origin", origin_at(35.45, 27.38)}});
  const Vector2d metres = metres_per_degree(27.38);
  EXPECT_LT((at(*water, 0, 0.05 * metres.x(), 0.01 * metres.y()) - Vector2d(0.05, 0.01)).norm(),
            float_rounding);
}

TEST(NetcdfCurrent, KnowsThatLongitudesRepeat) {
  const auto along = [](Values longitude, double origin) {
    File file = File::lon_lat(std::move(longitude), {-1, 0, 1});
    file.velocity = [](double, double, double lon, double) {
      return Vector2d(std::sin(lon * M_PI / 180.0), 0.0);
    };
    const auto water = open(file.write("round.nc"), {{"origin", origin_at(origin, 0)}});
    return at(*water, 0, 0.5 * metres_per_degree(0).x(), 0).x();
  };
  const auto between = [](double west, double east) {
    return 0.5 * (std::sin(west * M_PI / 180.0) + std::sin(east * M_PI / 180.0));
  };
  EXPECT_NEAR(along({329, 330, 331}, -30), between(330, 331), float_rounding);
  EXPECT_NEAR(along({-31, -30, -29}, 330), between(330, 331), float_rounding);
  EXPECT_NEAR(along({358, 359, 0, 1}, 359), between(359, 360), float_rounding);
  // All around the Earth, there is no seam.
  Values around;
  for (int degrees = 0; degrees < 360; ++degrees) around.push_back(degrees);
  EXPECT_NEAR(along(around, -1), between(359, 360), float_rounding);
  around.push_back(360);
  EXPECT_NEAR(along(around, 359), between(359, 360), float_rounding);
}

TEST(NetcdfCurrent, AsksForAnOriginAndSaysWhere) {
  const std::string why = refusal(File::lon_lat({-10, -9}, {50, 51}).write("where.nc"));
  EXPECT_SAYS(why, "set current.netcdf.origin = [[LON, LAT]]");
  EXPECT_SAYS(why, "longitude 10.0000 W to 9.0000 W and latitude 50.0000 N to 51.0000 N");
  EXPECT_SAYS(refusal(scratch("where.nc"), {{"origin", origin_at(50, -91)}}), "latitude");
}

TEST(NetcdfCurrent, SaysLongitudeAndLatitudeOfAPositionOutside) {
  const auto water =
      open(File::lon_lat({35, 36}, {27, 28}).write("out.nc"), {{"origin", origin_at(35.5, 27.5)}});
  EXPECT_SAYS(complaint([&] { at(*water, 0, metres_per_degree(27.5).x(), 0); }),
              "(36.5000 E, 27.5000 N)");
}

/// A projected grid on the equator, turned by `angle`, with its longitudes and latitudes.
File turned_grid(double angle, const std::string& u_name, const std::string& v_name) {
  File file;
  file.x = {-2000, -1000, 0, 1000, 2000};
  file.y = {-2000, -1000, 0, 1000, 2000};
  file.u_name = u_name;
  file.v_name = v_name;
  file.velocity = [](double, double, double x, double) { return Vector2d(0.3 + 1e-5 * x, 0.0); };
  file.variables = [=](NetcdfWriter& w) {
    Values longitude, latitude;
    const Vector2d metres = metres_per_degree(0);
    for (const double y : {-2000, -1000, 0, 1000, 2000}) {
      for (const double x : {-2000, -1000, 0, 1000, 2000}) {
        longitude.push_back(10 + (std::cos(angle) * x - std::sin(angle) * y) / metres.x());
        latitude.push_back((std::sin(angle) * x + std::cos(angle) * y) / metres.y());
      }
    }
    w.variable("lon", NC_DOUBLE, {"y", "x"}, longitude).text("units", "degrees_east");
    w.variable("lat", NC_DOUBLE, {"y", "x"}, latitude).text("units", "degrees_north");
  };
  return file;
}

TEST(NetcdfCurrent, TurnsAProjectedGridToEastAndNorthAtAnOriginInDegrees) {
  const double angle = 0.5;
  const File file = turned_grid(angle, "sea_water_x_velocity", "sea_water_y_velocity");
  const Vector2d metres = metres_per_degree(0);
  // The origin lies 500 m along the grid's x axis.
  const Setting origin =
      origin_at(10 + 500 * std::cos(angle) / metres.x(), 500 * std::sin(angle) / metres.y());
  const auto water = open(file.write("turned.nc"), {{"origin", origin}});
  const Vector2d along_x(std::cos(angle), std::sin(angle));
  EXPECT_LT((at(*water, 0, 0, 0) - 0.305 * along_x).norm(), 1e-6);
  EXPECT_LT((at(*water, 0, 1000 * along_x.x(), 1000 * along_x.y()) - 0.315 * along_x).norm(), 1e-6);
  EXPECT_SAYS(refusal(scratch("turned.nc"), {{"origin", origin_at(11, 0)}}), "outside the grid");
}

TEST(NetcdfCurrent, KeepsTheGridsOwnFrameWithoutAnOriginInDegrees) {
  const auto water =
      open(turned_grid(0.5, "x_sea_water_velocity", "y_sea_water_velocity").write("own.nc"));
  EXPECT_LT((at(*water, 0, 500, 0) - Vector2d(0.305, 0.0)).norm(), float_rounding);
}

TEST(NetcdfCurrent, RefusesEastwardVelocitiesInATurnedFrame) {
  const File file = turned_grid(0.5, "eastward_sea_water_velocity", "northward_sea_water_velocity");
  EXPECT_SAYS(refusal(file.write("mixed.nc")), "turned by 28.6 degrees");
  const auto water = open(scratch("mixed.nc"), {{"origin", origin_at(10, 0)}});
  EXPECT_LT((at(*water, 0, 0, 0) - Vector2d(0.3, 0.0)).norm(), 1e-6);
}

// --- understanding, and refusing -------------------------------------------------------------

TEST(NetcdfCurrent, ConvertsUnitsOfVelocity) {
  const auto speed = [](const std::string& units) {
    File file;
    file.units = units;
    file.velocity = [](double, double, double, double) { return Vector2d(1.0, 0.0); };
    return at(*open(file.write("units.nc")), 0, 0, 0).x();
  };
  for (const char* units : {"m s-1", "m/s", "meter second-1", "m.s-1", "metre/second", "m s^-1"}) {
    EXPECT_EQ(speed(units), 1.0) << units;
  }
  EXPECT_NEAR(speed("cm/s"), 0.01, 1e-9);
  EXPECT_NEAR(speed("cm s-1"), 0.01, 1e-9);
  EXPECT_NEAR(speed("knots"), 0.514444, 1e-6);
  EXPECT_THROW(speed("m"), InputError);
  EXPECT_THROW(speed("furlong/fortnight"), InputError);
  EXPECT_THROW(speed(""), InputError);
}

TEST(NetcdfCurrent, FindsVelocitiesByCommonNames) {
  File file;
  file.u_name = file.v_name = "";
  EXPECT_NO_THROW(open(file.write("common.nc")));
}

TEST(NetcdfCurrent, NamesTheCandidatesWhenThereAreTwo) {
  File file;
  file.variables = [](NetcdfWriter& w) {
    w.variable("u2", NC_DOUBLE, {"time", "y", "x"}, Values(36, 0.25))
        .text("standard_name", "surface_eastward_sea_water_velocity")
        .text("units", "m/s");
    w.variable("v2", NC_DOUBLE, {"time", "y", "x"}, Values(36, 0.5))
        .text("standard_name", "surface_northward_sea_water_velocity")
        .text("units", "m/s");
  };
  const std::string why = refusal(file.write("two.nc"));
  EXPECT_SAYS(why, "u and u2 with v and v2");
  const auto water = open(scratch("two.nc"), {{"u_variable", plain(std::string("u2"))},
                                              {"v_variable", plain(std::string("v2"))}});
  EXPECT_EQ(at(*water, 0, 50, 50), Vector2d(0.25, 0.5));
  EXPECT_SAYS(refusal(scratch("two.nc"), {{"u_variable", plain(std::string("u3"))},
                                          {"v_variable", plain(std::string("v2"))}}),
              "did you mean");
  EXPECT_SAYS(refusal(scratch("two.nc"), {{"u_variable", plain(std::string("u2"))}}), "together");
}

TEST(NetcdfCurrent, RefusesStaggeredAndCurvilinearGrids) {
  const auto write = [](const std::string& name, bool staggered) {
    NetcdfWriter w(scratch(name));
    w.dimension("eta", 3).dimension("xi", 3).dimension("xi_v", 2);
    w.variable("lon", NC_DOUBLE, {"eta", "xi"}, {0, 1, 2, 0, 1, 2, 0, 1, 3})
        .text("units", "degrees_east");
    w.variable("lat", NC_DOUBLE, {"eta", "xi"}, {0, 0, 0, 1, 1, 1, 2, 2, 2})
        .text("units", "degrees_north");
    w.variable("u", NC_DOUBLE, {"eta", "xi"}, Values(9, 0.0))
        .text("standard_name", "sea_water_x_velocity")
        .text("units", "m/s");
    w.variable("v", NC_DOUBLE, {"eta", staggered ? "xi_v" : "xi"}, Values(9, 0.0))
        .text("standard_name", "sea_water_y_velocity")
        .text("units", "m/s");
    w.finish();
    return refusal(scratch(name));
  };
  EXPECT_SAYS(write("curvilinear.nc", false), "u(eta, xi) stands on a curvilinear grid");
  EXPECT_SAYS(write("staggered.nc", true), "staggered (Arakawa C) grid");
}

TEST(NetcdfCurrent, RefusesAxesItWouldHaveToGuess) {
  File file;
  file.x_units = "";
  EXPECT_SAYS(refusal(file.write("no_units.nc")), "the axis x has no units");
  file.x_units = "furlongs";
  EXPECT_SAYS(refusal(file.write("furlongs.nc")), "furlongs");
  file = File{};
  file.x = {0, 200, 100};
  EXPECT_SAYS(refusal(file.write("jumping.nc")), "x is not strictly monotonic");
  file.x = {0};
  EXPECT_SAYS(refusal(file.write("point.nc")), "a single point");
  file = File{};
  std::swap(file.x_units, file.time_units);
  EXPECT_NE(refusal(file.write("swapped.nc")), "");
}

TEST(NetcdfCurrent, RefusesDimensionsInAnotherOrder) {
  NetcdfWriter w(scratch("order.nc"));
  w.dimension("x", 2).dimension("y", 2);
  w.variable("x", NC_DOUBLE, {"x"}, {0, 1}).text("units", "m").text("axis", "X");
  w.variable("y", NC_DOUBLE, {"y"}, {0, 1}).text("units", "m").text("axis", "Y");
  w.variable("u", NC_DOUBLE, {"x", "y"}, Values(4, 0.0)).text("units", "m/s");
  w.variable("v", NC_DOUBLE, {"x", "y"}, Values(4, 0.0)).text("units", "m/s");
  w.finish();
  EXPECT_SAYS(refusal(scratch("order.nc")), "in the order time, depth, y, x");
}

TEST(NetcdfCurrent, RefusesFilesThatAreNone) {
  EXPECT_SAYS(refusal(scratch("missing.nc")), "there is no file");
  EXPECT_SAYS(refusal(scratch("missing.nc").parent_path()), "is a folder");
  std::ofstream(scratch("text.nc")) << "u,v\n1,2\n";
  EXPECT_SAYS(refusal(scratch("text.nc")), "text.nc: is not a netCDF file");
  std::ofstream(scratch("empty.nc")).close();
  EXPECT_SAYS(refusal(scratch("empty.nc")), "is not a netCDF file");
  EXPECT_SAYS(complaint([] { Registry<Current>::instance().make("netcdf", {}, "current.netcdf"); }),
              "no file is named");
}

TEST(NetcdfCurrent, RefusesTruncatedFilesOfEveryFormat) {
  for (const int format : {0, NC_64BIT_OFFSET, NC_NETCDF4}) {
    const fs::path path = File{}.write("whole.nc", format);
    EXPECT_NO_THROW(open(path));
    const auto size = fs::file_size(path);
    for (const auto kept : {size - 8, size / 2, std::uintmax_t{6}}) {
      fs::copy_file(path, scratch("cut.nc"), fs::copy_options::overwrite_existing);
      fs::resize_file(scratch("cut.nc"), kept);
      EXPECT_NE(refusal(scratch("cut.nc")), "") << format << " " << kept;
    }
  }
}

TEST(GridAxis, FindsTheCellOnAnyAxis) {
  EXPECT_TRUE(rc::check("between two nodes", [] {
    const auto gaps =
        *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 100000)));
    Values nodes{-123.0};
    for (const int gap : gaps) nodes.push_back(nodes.back() + gap * 1e-3);
    const GridAxis axis(nodes);
    const double share = *rc::gen::inRange(0, 1000001) * 1e-6;
    const double x = std::min(nodes.front() + share * (nodes.back() - nodes.front()), nodes.back());
    GridAxis::Place place;
    RC_ASSERT(axis.locate(x, place));
    const double low = nodes[place.cell], high = nodes[place.cell + 1];
    RC_ASSERT(std::abs(low + place.fraction * (high - low) - x) < 1e-9);
    RC_ASSERT(place.fraction > -1e-8 && place.fraction < 1.0 + 1e-8);
  }));
}

// --- the report ------------------------------------------------------------------------------

TEST(CurrentReport, SaysWhatWasUnderstood) {
  File file = with_hole(NAN);
  file.depth = {0, 10};
  const std::string text = describe_current_file(file.write("report.nc"));
  EXPECT_SAYS(text, "projected, 3 x 4 points");
  EXPECT_SAYS(text, "x: 3 points from 0 to 200 m, step 100");
  EXPECT_SAYS(text, "2014-12-01T00:00:00Z to 2014-12-01T00:20:00Z, standard calendar");
  EXPECT_SAYS(text, "3 steps over 1200 s, step 600 s");
  EXPECT_SAYS(text, "2 levels from 0 to 10 m");
  EXPECT_SAYS(text, "8.3 % of 72 values");
  EXPECT_SAYS(text, "1.414 to 1.414 m/s, mean velocity (1.000, 1.000) m/s");
}

TEST(CurrentReport, SaysHowVelocitiesArePacked) {
  File file;
  file.type = NC_SHORT;
  file.scale = -1e-4;
  file.offset = 0.5;
  EXPECT_SAYS(describe_current_file(file.write("packed.nc")),
              "u in m s-1, stored as int16 x -1e-04 + 0.5");
}

// --- public files ----------------------------------------------------------------------------

TEST(PublicCurrents, RedSeaReconstructionIsRead) {
  const fs::path path = tests::shared_data("redsea_current.nc");
  SHOAL_NEEDS_SHARED(path);
  const auto water = open(path, {{"time_offset_s", plain(59.0)}});
  EXPECT_NO_THROW(water->require_duration(18000.0));
  EXPECT_THROW(water->require_duration(18142.0), InputError);
  // By an independent reading with numpy: time 100 s, nodes (0, 200) and (200, 200).
  const Vector2d velocity = at(*water, 41.0, 100, 200);
  EXPECT_LT((velocity - Vector2d(-0.070015, 0.054145)).norm(), float_rounding);
  // Its axes are east and north of the same origin that its longitudes and latitudes tell.
  const auto placed =
      open(path, {{"origin", origin_at(35.45, 27.38)}, {"time_offset_s", plain(59.0)}});
  EXPECT_LT((at(*placed, 41.0, 100, 200) - velocity).norm(), 1e-6);
  EXPECT_SAYS(describe_current_file(path), "183 steps over 18200 s, step 100 s");
}

TEST(PublicCurrents, CoastalAltimetryIsRead) {
  const fs::path path = tests::shared_data("ocean/redsea_duacs_geostrophic_20190223.nc");
  SHOAL_NEEDS_SHARED(path);
  EXPECT_SAYS(refusal(path, {{"origin", origin_at(37.5, 21)}}),
              "a single time, 2019-02-23T00:00:00Z");
  const auto water = open(path, {{"origin", origin_at(37.625, 21.125)}, {"outside", clamp}});
  EXPECT_LT((at(*water, 1e5, 0, 0) - Vector2d(0.1439, -0.1343)).norm(), float_rounding);
  EXPECT_SAYS(describe_current_file(path), "84.0 % of 3552 values");
}

TEST(PublicCurrents, PolarStereographicModelIsRead) {
  const fs::path path = tests::shared_data("ocean/metno_arctic20_roms_polarstereo_201702.nc");
  SHOAL_NEEDS_SHARED(path);
  EXPECT_SAYS(describe_current_file(path), "along the grid's x and y axes, not east and north");
  EXPECT_SAYS(describe_current_file(path), "one level, at 0 m");
  const Changes origin{{"origin_x_m", plain(-2760000.0)}, {"origin_y_m", plain(-2010000.0)}};
  const Vector2d along_grid = at(*open(path, origin), 5400, 0, 0);
  EXPECT_LT((along_grid - Vector2d(0.07552028819918633, 0.059018904343247414)).norm(),
            float_rounding);
  // At 3 E, 58 E being straight down, the grid's x axis points 55 degrees north of east.
  const auto turned = open(path, {{"origin", origin_at(3, 60)}});
  const double angle = 55.0 * M_PI / 180.0;
  const Vector2d placed =
      at(*open(path, {{"origin_x_m", plain(-2609408.837)}, {"origin_y_m", plain(-1827127.738)}}),
         5400, 0, 0);
  const Vector2d expected(std::cos(angle) * placed.x() - std::sin(angle) * placed.y(),
                          std::sin(angle) * placed.x() + std::cos(angle) * placed.y());
  EXPECT_LT((at(*turned, 5400, 0, 0) - expected).norm(), 1e-3);
}

TEST(PublicCurrents, CurvilinearStaggeredModelIsRefused) {
  const fs::path path = tests::shared_data("ocean/noaa_wcofs_roms_curvilinear.nc");
  SHOAL_NEEDS_SHARED(path);
  const std::string why = complaint([&] { describe_current_file(path); });
  EXPECT_SAYS(why, "a staggered (Arakawa C) grid, and a curvilinear one");
}

}  // namespace
}  // namespace shoal::scenarios
