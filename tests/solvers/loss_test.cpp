#include "shoal/solvers/loss.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::solvers {
namespace {

constexpr double scale_m = 2.0;

/// A loss of scale 2 m, if it has a scale.
std::unique_ptr<Loss> scaled_loss(const std::string& name) {
  const auto& losses = Registry<Loss>::instance();
  Setting options;
  if (losses.find(name) && losses.find(name)->schema().find("scale_m")) {
    options.at_or_new("scale_m").value = scale_m;
  }
  return losses.make(name, options, "loss." + name);
}

// Squares of residuals from a hundredth of the scale to a hundred of it, the scale left out: there
// a second derivative may jump.
std::vector<double> squares() {
  std::vector<double> all;
  for (double r = 0.011 * scale_m; r < 100.0 * scale_m; r *= 1.3) all.push_back(r * r);
  return all;
}

class EveryLoss : public testing::TestWithParam<std::string> {
 protected:
  const std::unique_ptr<Loss> tested = scaled_loss(GetParam());
};

TEST_P(EveryLoss, HasTheDerivativesThatDifferencesShow) {
  for (const double squared : squares()) {
    const LossValue here = tested->at(squared);
    const double h = 1e-4 * squared;
    const LossValue above = tested->at(squared + h), below = tested->at(squared - h);
    EXPECT_NEAR(here.slope, (above.value - below.value) / (2.0 * h), 1e-7) << squared;
    EXPECT_NEAR(here.curvature * squared, (above.slope - below.slope) / (2.0 * h) * squared, 1e-7)
        << squared;
  }
}

TEST_P(EveryLoss, IsTheSquareNearZero) {
  const LossValue zero = tested->at(0.0);
  EXPECT_EQ(zero.value, 0.0);
  EXPECT_EQ(zero.slope, 1.0);
  const double rounding = 1e-15 * scale_m * scale_m;
  for (const double r : {1e-8, 1e-5, 1e-3, 1e-2}) {
    const LossValue here = tested->at(r * r);
    EXPECT_NEAR(here.value, r * r, r * r * r * r + rounding) << r;
    EXPECT_NEAR(here.slope, 1.0, r * r) << r;
  }
}

TEST_P(EveryLoss, NeverFallsAndNeverGrowsFasterThanTheSquare) {
  LossValue before = tested->at(0.0);
  for (const double squared : squares()) {
    const LossValue here = tested->at(squared);
    EXPECT_GE(here.value, before.value) << squared;
    EXPECT_LE(here.value, squared) << squared;
    EXPECT_GE(here.slope, 0.0) << squared;
    EXPECT_LE(here.slope, before.slope) << squared;
    EXPECT_LE(here.curvature, 0.0) << squared;
    before = here;
  }
}

TEST_P(EveryLoss, IsContinuousWithItsSlopeAtItsScale) {
  const double at = scale_m * scale_m;
  const LossValue below = tested->at(at * (1.0 - 1e-9)), above = tested->at(at * (1.0 + 1e-9));
  EXPECT_NEAR(below.value, above.value, 1e-7);
  EXPECT_NEAR(below.slope, above.slope, 1e-7);
}

TEST_P(EveryLoss, StaysFiniteForResidualsBeyondAllReason) {
  const LossValue far = tested->at(1e24);
  EXPECT_TRUE(std::isfinite(far.value) && std::isfinite(far.slope) && std::isfinite(far.curvature));
}

TEST_P(EveryLoss, IsTheSquareEverywhereIfItSaysSo) {
  const bool square_far_away = tested->at(1e6).value == 1e6;
  EXPECT_EQ(tested->is_square(), square_far_away);
}

INSTANTIATE_TEST_SUITE_P(Losses, EveryLoss, testing::ValuesIn(Registry<Loss>::instance().names()),
                         [](const auto& tested) { return tested.param; });

void expect_loss(const std::string& name, double squared, const LossValue& by_hand) {
  const LossValue found = scaled_loss(name)->at(squared);
  EXPECT_NEAR(found.value, by_hand.value, 1e-14) << name << " of " << squared;
  EXPECT_NEAR(found.slope, by_hand.slope, 1e-15) << name << " of " << squared;
  EXPECT_NEAR(found.curvature, by_hand.curvature, 1e-15) << name << " of " << squared;
}

TEST(Loss, HasTheValuesOneComputesByHand) {
  expect_loss("least_squares", 9.0, {9.0, 1.0, 0.0});
  expect_loss("huber", 1.0, {1.0, 1.0, 0.0});
  expect_loss("huber", 4.0, {4.0, 1.0, 0.0});
  expect_loss("huber", 9.0, {8.0, 2.0 / 3.0, -1.0 / 27.0});  // 2 * 2 * 3 - 4
  expect_loss("cauchy", 4.0, {4.0 * std::log(2.0), 0.5, -1.0 / 16.0});
  expect_loss("cauchy", 12.0, {4.0 * std::log(4.0), 0.25, -1.0 / 64.0});
  expect_loss("tukey", 1.0, {37.0 / 48.0, 9.0 / 16.0, -3.0 / 8.0});
  expect_loss("tukey", 4.0, {4.0 / 3.0, 0.0, 0.0});
  expect_loss("tukey", 9.0, {4.0 / 3.0, 0.0, 0.0});
}

TEST(Loss, RefusesAScaleThatIsNotPositive) {
  for (const char* name : {"huber", "cauchy", "tukey"}) {
    Setting options;
    options.at_or_new("scale_m").value = 0.0;
    EXPECT_THROW(Registry<Loss>::instance().make(name, options, "loss"), InputError) << name;
  }
}

}  // namespace
}  // namespace shoal::solvers
