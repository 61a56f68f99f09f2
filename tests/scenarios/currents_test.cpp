#include "shoal/scenarios/currents/current.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::scenarios {
namespace {

std::unique_ptr<Current> current(const std::string& kind,
                                 const std::vector<std::pair<std::string, double>>& options = {}) {
  Setting table;
  for (const auto& [name, value] : options) table.at_or_new(name).value = value;
  return Registry<Current>::instance().make(kind, table, "current." + kind);
}

Eigen::Vector2d velocity_at(const Current& water, double x, double y, double time = 0.0) {
  Eigen::Vector2d velocity;
  water.sample(time, {&x, 1}, {&y, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  return velocity;
}

TEST(StillWater, MovesNowhere) {
  EXPECT_EQ(velocity_at(*current("none"), 123.0, -4.0, 5.0), Eigen::Vector2d::Zero());
}

TEST(UniformCurrent, IsTheSameEverywhere) {
  const auto water = current("uniform", {{"u_m_s", 0.1}, {"v_m_s", -0.2}});
  EXPECT_EQ(velocity_at(*water, 0.0, 0.0), Eigen::Vector2d(0.1, -0.2));
  EXPECT_EQ(velocity_at(*water, 1e4, -1e4, 1e5), Eigen::Vector2d(0.1, -0.2));
}

TEST(UniformCurrent, SamplesManyPositionsAtOnce) {
  const std::vector<double> x{0.0, 1.0, 2.0}, y{0.0, 5.0, 6.0};
  std::vector<double> u(3), v(3);
  current("uniform", {{"u_m_s", 0.1}})->sample(0.0, x, y, u, v);
  EXPECT_EQ(u, std::vector<double>(3, 0.1));
  EXPECT_EQ(v, std::vector<double>(3, 0.0));
}

TEST(Shear, ChangesAcrossAndWithDepth) {
  const auto water = current("shear", {{"u_m_s", 0.1}, {"u_per_y", 1e-3}, {"v_per_depth", -2e-3}});
  EXPECT_EQ(velocity_at(*water, 500.0, 0.0), Eigen::Vector2d(0.1, 0.0));
  EXPECT_NEAR(velocity_at(*water, 0.0, -300.0).x(), -0.2, 1e-15);
  const double x = 0.0, y = 100.0, depth = 50.0;
  Eigen::Vector2d velocity;
  water->sample_at(0.0, {&x, 1}, {&y, 1}, {&depth, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  EXPECT_NEAR(velocity.x(), 0.2, 1e-15);
  EXPECT_NEAR(velocity.y(), -0.1, 1e-15);
}

TEST(Channels, RunOppositeWithStillWaterBetween) {
  const auto water = current("channels");
  EXPECT_EQ(velocity_at(*water, 7.0, 151.0), Eigen::Vector2d(0.1, 0.0));
  EXPECT_EQ(velocity_at(*water, 7.0, -151.0), Eigen::Vector2d(-0.1, 0.0));
  EXPECT_EQ(velocity_at(*water, 7.0, 20.0), Eigen::Vector2d::Zero());
}

TEST(Channels, AreStillOnTheBanksThemselves) {
  const auto water = current("channels");
  EXPECT_EQ(velocity_at(*water, 0.0, 150.0), Eigen::Vector2d::Zero());
  EXPECT_EQ(velocity_at(*water, 0.0, -150.0), Eigen::Vector2d::Zero());
  EXPECT_GT(velocity_at(*water, 0.0, std::nextafter(150.0, 200.0)).x(), 0.0);
}

TEST(Vortex, TurnsCounterClockwiseWithTheSpeedOfTheThesis) {
  const auto water = current("vortex");
  // 1 / (400 / 200 + 2) = 0.25 m/s.
  EXPECT_LT((velocity_at(*water, 400.0, 0.0) - Eigen::Vector2d(0.0, 0.25)).norm(), 1e-15);
  EXPECT_LT((velocity_at(*water, 0.0, 400.0) - Eigen::Vector2d(-0.25, 0.0)).norm(), 1e-15);
  EXPECT_LT((velocity_at(*water, -240.0, -320.0) - Eigen::Vector2d(0.2, -0.15)).norm(), 1e-15);
}

TEST(Vortex, FlowsNorthWithHalfAMetrePerSecondAtItsCentre) {
  EXPECT_EQ(velocity_at(*current("vortex"), 0.0, 0.0), Eigen::Vector2d(0.0, 0.5));
}

TEST(Vortex, IsNotIrrotational) {
  // Its circulation along a circle grows with the radius; that of an irrotational one does not.
  const auto water = current("vortex");
  const auto circulation = [&](double r) { return r * velocity_at(*water, r, 0.0).y(); };
  EXPECT_GT(circulation(400.0), 1.5 * circulation(200.0));
}

TEST(Currents, RefuseOptionsOutOfRange) {
  EXPECT_THROW(current("channels", {{"half_width_m", -1.0}}), InputError);
  EXPECT_THROW(current("vortex", {{"scale_m", 0.0}}), InputError);
  EXPECT_THROW(current("uniform", {{"w_m_s", 0.0}}), InputError);
}

TEST(Currents, LastForEverUnlessTheyComeFromAFile) {
  for (const char* kind : {"none", "uniform", "channels", "vortex"}) {
    EXPECT_NO_THROW(current(kind)->require_duration(1e9));
  }
}

}  // namespace
}  // namespace shoal::scenarios
