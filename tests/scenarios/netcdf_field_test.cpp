#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "tests/support/current_files.hpp"

namespace shoal::scenarios {
namespace {

using namespace current_files;

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

TEST(NetcdfCurrent, RefusesFillValuesThatWereNotDeclared) {
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
  EXPECT_SAYS(why, "current.netcdf.outside = \"clamp_place\"");
}

TEST(NetcdfCurrent, SaysWhereATimeHasNoVelocityAtAll) {
  File file;
  file.velocity = [](double t, double, double, double) {
    return t == 600 ? Vector2d(NAN, NAN) : Vector2d(1.0, 1.0);
  };
  const fs::path path = file.write("empty_time.nc");
  const std::vector<Changes> all{{}, {{"outside", clamp}}, {{"outside", clamp_place}}};
  for (const Changes& outside : all) {
    const auto water = open(path, outside);
    EXPECT_EQ(at(*water, 0, 50, 50).x(), 1.0);
    for (const double t : {500.0, 600.0}) {
      const std::string why = complaint([&] { at(*water, t, 50, 50); });
      EXPECT_SAYS(why, "the velocities at that time and depth are all missing; begin or end");
      EXPECT_SAYS(why, "t = " + std::string(t == 600 ? "600" : "500") + " s (2014-12-01T00:");
      EXPECT_EQ(why.find("land"), std::string::npos) << why;
      EXPECT_EQ(why.find("clamp"), std::string::npos) << why;
    }
  }
  // A place outside the grid takes the nearest one, where nothing is known either.
  const auto water = open(path, {{"outside", clamp}});
  EXPECT_SAYS(complaint([&] { at(*water, 600, -500, 50); }), "are all missing");
}

TEST(NetcdfCurrent, ClampsLandToTheNearestWetNode) {
  const fs::path path = with_coast().write("coast.nc");
  for (const auto& held : {clamp, clamp_place}) {
    const auto water = open(path, {{"outside", held}});
    EXPECT_LT((at(*water, 60, 310, 50) - Vector2d(0.1, 0.5)).norm(), float_rounding);
    EXPECT_LT((at(*water, 60, 5000, 50) - Vector2d(0.1, 0.5)).norm(), float_rounding);
  }
}

TEST(NetcdfCurrent, RefusesAFileThatIsAllLand) {
  File file;
  file.velocity = [](double, double, double, double) { return Vector2d(NAN, NAN); };
  EXPECT_SAYS(refusal(file.write("land.nc")), "every value is missing");
}

TEST(NetcdfCurrent, ItsStrengthMultipliesTheVelocitiesOfTheFile) {
  File file;
  file.velocity = [](double, double, double, double) { return Vector2d(0.1, -0.2); };
  const auto halved = open(file.write("strength.nc"), {{"strength", plain(0.5)}});
  EXPECT_NEAR(at(*halved, 0, 0, 0).x(), 0.05, float_rounding);
  EXPECT_NEAR(at(*halved, 0, 0, 0).y(), -0.1, float_rounding);
}

}  // namespace
}  // namespace shoal::scenarios
