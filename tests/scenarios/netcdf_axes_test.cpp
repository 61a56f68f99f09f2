#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "shoal/scenarios/currents/netcdf_axis.hpp"
#include "shoal/scenarios/currents/netcdf_frame.hpp"
#include "tests/support/current_files.hpp"

namespace shoal::scenarios {
namespace {

using namespace current_files;

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

TEST(NetcdfCurrent, ClampingThePlaceLeavesATimeOutsideAnError) {
  File file;
  file.depth = {5, 20};
  file.velocity = [](double t, double z, double x, double) {
    return Vector2d(1e-4 * t + 0.01 * z, 1e-3 * x);
  };
  const fs::path path = file.write("place.nc");
  const auto water = open(path, {{"outside", clamp_place}});
  const double x = 500, y = 50, deep = 100;
  Vector2d velocity;
  water->sample_at(600, {&x, 1}, {&y, 1}, {&deep, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  EXPECT_LT((velocity - file.velocity(600, 20, 200, 50)).norm(), float_rounding);
  EXPECT_LT((at(*water, 600, x, y) - file.velocity(600, 5, 200, 50)).norm(), float_rounding);
  EXPECT_SAYS(complaint([&] { water->require_duration(1201); }), "no current at t = 1201 s");
  EXPECT_SAYS(complaint([&] { at(*water, 1201, 50, 50); }), "outside = \"clamp\"");
  file.time = {3600};
  EXPECT_SAYS(refusal(file.write("single.nc"), {{"outside", clamp_place}}), "a single time");
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

TEST(NetcdfCurrent, MeetsEveryVehicleAtItsOwnDepth) {
  File file;
  file.depth = {20, 0};
  file.velocity = [](double, double z, double x, double) {
    return Vector2d(0.1 + 0.01 * z, 1e-3 * x);
  };
  const fs::path path = file.write("two.nc");
  const auto water = open(path);
  const std::vector<double> x{50, 60, 70, 80}, y{50, 50, 60, 60}, depth{0, 5, 20, -0.01};
  std::vector<double> u(4), v(4);
  water->sample_at(0, x, y, depth, u, v);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(u[k], 0.1 + 0.01 * std::max(0.0, depth[k]), float_rounding) << k;
    const Changes fixed{{"depth", plain(std::string("fixed"))},
                        {"depth_m", plain(std::max(0.0, depth[k]))}};
    const Vector2d there = at(*open(path, fixed), 0, x[k], y[k]);
    EXPECT_NEAR(u[k], there.x(), float_rounding);
    EXPECT_NEAR(v[k], there.y(), float_rounding);
  }
  // Maps show the surface; a fixed depth holds for all.
  EXPECT_NEAR(at(*water, 0, 50, 50).x(), 0.1, float_rounding);
  const Changes at_ten{{"depth", plain(std::string("fixed"))}, {"depth_m", plain(10.0)}};
  open(path, at_ten)->sample_at(0, x, y, depth, u, v);
  for (const double each : u) EXPECT_NEAR(each, 0.2, float_rounding);
}

TEST(NetcdfCurrent, MeetsVehiclesAtTheirDepthsFromItsStartOn) {
  File file;
  file.depth = {0, 20};
  file.velocity = [](double t, double z, double, double) { return Vector2d(1e-4 * t, 0.01 * z); };
  file.time = {0, 600, 1200};
  const auto water = open(file.write("later.nc"), {{"time_offset_s", plain(300.0)}});
  const std::vector<double> x{50, 60}, y{50, 50}, depth{5, 15};
  std::vector<double> u(2), v(2);
  water->sample_at(60, x, y, depth, u, v);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(u[k], 0.036, float_rounding);
    EXPECT_NEAR(v[k], 0.01 * depth[k], float_rounding);
  }
}

TEST(NetcdfCurrent, RefusesAVehicleThatLeavesTheDepths) {
  File file;
  file.depth = {5, 20};
  file.velocity = [](double, double z, double, double) { return Vector2d(0.01 * z, 0); };
  const fs::path path = file.write("two.nc");
  const double x = 50, y = 50;
  double u = 0, v = 0;
  const auto met = [&](const Current& water, double depth) {
    water.sample_at(0, {&x, 1}, {&y, 1}, {&depth, 1}, {&u, 1}, {&v, 1});
    return u;
  };
  const auto water = open(path, {{"depth_m", plain(5.0)}});
  EXPECT_NEAR(met(*water, 12), 0.12, float_rounding);
  EXPECT_SAYS(complaint([&] { met(*water, 21); }), "no current at a depth of 21 m");
  EXPECT_SAYS(complaint([&] { met(*water, 4); }), "levels run from 5 to 20 m");
  const auto clamped = open(path, {{"outside", clamp}});
  EXPECT_NEAR(met(*clamped, 21), 0.2, float_rounding);
  EXPECT_NEAR(met(*clamped, 4), 0.05, float_rounding);
}

TEST(NetcdfCurrent, WithoutLevelsIsTheSameAtEveryDepth) {
  File file;
  const auto water = open(file.write("surface.nc"));
  const double x = 50, y = 50, depth = 100;
  Vector2d velocity;
  water->sample_at(0, {&x, 1}, {&y, 1}, {&depth, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  EXPECT_EQ(velocity, at(*water, 0, x, y));
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

}  // namespace
}  // namespace shoal::scenarios
