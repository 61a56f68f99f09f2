#include "shoal/formations/guidances/drift.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace shoal::formations {
namespace {

using Eigen::Vector2d;

/// A guidance and the memory of its vehicle.
class Pilot {
 public:
  explicit Pilot(const DriftOptions& options = {}) : guidance_(options) {}

  Command to(double x, double y) {
    return guidance_.command(Target::at({x, y}, 0.0), {x, y}, {}, memory_.get());
  }

 private:
  Drift guidance_;
  OwnedMemory memory_ = guidance_.new_memory();
};

Setting options_of(std::initializer_list<std::pair<const char*, double>> entries) {
  Setting setting;
  for (const auto& [name, x] : entries) setting.at_or_new(name).value = x;
  return setting;
}

std::string complaint(const Setting& options) {
  DriftOptions guidance;
  try {
    read(guidance, options, "guidance");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Drift, HasTheDefaultsOfTheThesis) {  // Table 3.1
  const DriftOptions g;
  EXPECT_EQ(g.speed_m_s, 1.0);
  EXPECT_EQ(g.capture_radius_m, 3.0);
  EXPECT_EQ(g.slip_radius_m, 10.0);
  EXPECT_EQ(g.drifting_radius_m, 20.0);
  EXPECT_EQ(g.end_speed_scale, 0.5);
  EXPECT_EQ(g.targets_filter_size, 1);
}

TEST(Drift, DriftsAtFirstUntilTheTargetIsOutsideTheDriftingRadius) {
  Pilot pilot;
  EXPECT_FALSE(pilot.to(19.9, 0).thrust);
  EXPECT_FALSE(pilot.to(20.0, 0).thrust);
  EXPECT_TRUE(pilot.to(20.1, 0).thrust);
}

TEST(Drift, HeadsForTheTargetAtTransitSpeed) {
  Pilot pilot;
  const Command west = pilot.to(-50.0, 0.0);
  EXPECT_TRUE(west.thrust);
  EXPECT_EQ(west.speed_m_s, 1.0);
  EXPECT_DOUBLE_EQ(west.heading_rad, std::numbers::pi);
  EXPECT_DOUBLE_EQ(pilot.to(30.0, 30.0).heading_rad, std::numbers::pi / 4);
}

TEST(Drift, SlowsLinearlyBetweenDriftingAndCaptureRadius) {
  Pilot pilot;
  EXPECT_EQ(pilot.to(0, 21).speed_m_s, 1.0);
  EXPECT_DOUBLE_EQ(pilot.to(0, 20).speed_m_s, 1.0);
  EXPECT_DOUBLE_EQ(pilot.to(0, 11.5).speed_m_s, 0.75);  // half way from 20 m to 3 m
  EXPECT_DOUBLE_EQ(pilot.to(0, 5.125).speed_m_s, 0.5625);
  EXPECT_DOUBLE_EQ(pilot.to(0, 3).speed_m_s, 0.5);
}

TEST(Drift, ScalesTheEndSpeedWithTheTransitSpeed) {
  Pilot pilot({.speed_m_s = 0.4, .end_speed_scale = 0.25});
  EXPECT_EQ(pilot.to(0, 21).speed_m_s, 0.4);
  EXPECT_DOUBLE_EQ(pilot.to(0, 11.5).speed_m_s, 0.4 * 0.625);
  EXPECT_DOUBLE_EQ(pilot.to(0, 3).speed_m_s, 0.1);
}

TEST(Drift, ArrivesInsideTheCaptureRadius) {
  Pilot pilot;
  pilot.to(25, 0);
  EXPECT_TRUE(pilot.to(3.0, 0).thrust);
  const Command arrived = pilot.to(2.99, 0);
  EXPECT_FALSE(arrived.thrust);
  EXPECT_EQ(arrived.speed_m_s, 0.0);
}

TEST(Drift, ArrivesInsideTheSlipRadiusWhenItNoLongerCloses) {
  Pilot pilot;
  pilot.to(25, 0);
  EXPECT_TRUE(pilot.to(9.0, 0).thrust);
  EXPECT_TRUE(pilot.to(8.0, 0).thrust);
  EXPECT_FALSE(pilot.to(8.1, 0).thrust);
}

TEST(Drift, DoesNotArriveOutsideTheSlipRadiusWhenItNoLongerCloses) {
  Pilot pilot;
  pilot.to(25, 0);
  EXPECT_TRUE(pilot.to(12.0, 0).thrust);
  EXPECT_TRUE(pilot.to(13.0, 0).thrust);
}

// Section 3.2 describes the latch that Alg. 1 as printed lacks.
TEST(Drift, HoldsTheDriftLatchUntilTheVehicleLeavesTheDriftingRadius) {
  Pilot pilot;
  pilot.to(25, 0);
  EXPECT_FALSE(pilot.to(1, 0).thrust);
  EXPECT_FALSE(pilot.to(0, -19).thrust);  // the target moved, but inside the radius
  EXPECT_FALSE(pilot.to(15, 0).thrust);
  EXPECT_TRUE(pilot.to(20.5, 0).thrust);
  EXPECT_TRUE(pilot.to(15, 0).thrust);  // and now it goes all the way
}

TEST(Drift, DriftsOnWhenTheTargetIsTheOwnPosition) {
  Pilot pilot;
  EXPECT_FALSE(pilot.to(0, 0).thrust);
  pilot.to(40, 0);
  EXPECT_FALSE(pilot.to(0, 0).thrust);  // a held target: arrived at once
}

TEST(Drift, AveragesTheLastTargets) {  // Alg. 2
  Pilot pilot({.targets_filter_size = 3});
  EXPECT_DOUBLE_EQ(pilot.to(30, 0).heading_rad, 0.0);                     // mean (30, 0)
  EXPECT_DOUBLE_EQ(pilot.to(0, 30).heading_rad, std::numbers::pi / 4);    // (15, 15)
  EXPECT_DOUBLE_EQ(pilot.to(-30, 30).heading_rad, std::numbers::pi / 2);  // (0, 20)
  EXPECT_DOUBLE_EQ(pilot.to(-30, -60).heading_rad, std::numbers::pi);     // (-20, 0)
  // (-10, 10): the first two have left.
  EXPECT_DOUBLE_EQ(pilot.to(30, 60).heading_rad, 3.0 * std::numbers::pi / 4);
}

TEST(Drift, JudgesDistanceByTheAveragedTarget) {
  Pilot pilot({.targets_filter_size = 2});
  EXPECT_TRUE(pilot.to(30, 0).thrust);
  EXPECT_FALSE(pilot.to(-30, 0).thrust);  // the mean is here
}

TEST(Drift, IsCopiedWithItsLatch) {
  Pilot pilot;
  pilot.to(25, 0);
  Pilot copy = pilot;
  EXPECT_FALSE(pilot.to(1, 0).thrust);
  EXPECT_TRUE(copy.to(15, 0).thrust);    // still under way
  EXPECT_FALSE(pilot.to(15, 0).thrust);  // latched
}

TEST(Drift, ComplainsOfRadiiThatDoNotGrow) {
  EXPECT_EQ(complaint(options_of({})), "");
  EXPECT_THROW(Drift({.capture_radius_m = 11}), InputError);
  EXPECT_EQ(complaint(options_of({{"capture_radius_m", 3}, {"slip_radius_m", 3}})), "");
  for (const Setting& wrong :
       {options_of({{"capture_radius_m", 11}}), options_of({{"slip_radius_m", 21}}),
        options_of({{"drifting_radius_m", 9}}),
        options_of({{"capture_radius_m", 20}, {"slip_radius_m", 20}})}) {
    EXPECT_EQ(complaint(wrong),
              "guidance: the radii must grow: capture_radius_m <= slip_radius_m <= "
              "drifting_radius_m");
  }
}

}  // namespace
}  // namespace shoal::formations
