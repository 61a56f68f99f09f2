#include "shoal/analysis/statistics/sensitivity/morris_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/analysis/sensitivity_functions.hpp"

namespace shoal::analysis {
namespace {

using namespace test;  // NOLINT: the functions are few, and all of them are meant

using List = std::vector<std::optional<double>>;

Eigen::MatrixXd morris(std::int64_t trajectories, int factors) {
  return draw("morris", "trajectories", trajectories, factors);
}

TEST(MorrisEffects, OfASumAreItsCoefficientsWithoutScatter) {
  const std::vector<double> c = {1.0, -2.0, 0.0, 30.0};
  const Eigen::MatrixXd cells = morris(10, 4);
  const MorrisEffects effects = morris_effects(cells, answers(cells, linear(c).f));
  EXPECT_EQ(effects.trajectories, 10);
  ASSERT_EQ(effects.factors.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const MorrisEffect& effect = effects.factors[i];
    EXPECT_NEAR(effect.mu, c[i], 1e-13);  // rounding of answers near 30, over delta
    EXPECT_NEAR(effect.mu_star.value, std::abs(c[i]), 1e-13);
    EXPECT_NEAR(*effect.sigma, 0.0, 1e-13);
    EXPECT_EQ(effect.mu_star.distinguishable(), c[i] != 0.0);
  }
}

TEST(MorrisEffects, AreMeanMeanSizeAndDeviationOfTheElementaryEffects) {
  // Two factors, two trajectories with delta = 2/3, worked by hand.
  Eigen::MatrixXd cells(6, 2);
  cells << 0.0, 1.0, 2.0 / 3.0, 1.0, 2.0 / 3.0, 1.0 / 3.0,  //
      1.0, 0.0, 1.0, 2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0;
  const List y = {1.0, 3.0, 7.0, 2.0, 4.0, 6.0};
  // Effects of the first factor: (3 - 1) / (2/3) = 3 and (6 - 4) / (-2/3) = -3;
  // of the second: (7 - 3) / (-2/3) = -6 and (4 - 2) / (2/3) = 3.
  const MorrisEffects effects = morris_effects(cells, y);
  ASSERT_EQ(effects.factors.size(), 2U);
  EXPECT_NEAR(effects.factors[0].mu, 0.0, 1e-14);
  EXPECT_NEAR(effects.factors[0].mu_star.value, 3.0, 1e-14);
  EXPECT_NEAR(*effects.factors[0].sigma, std::sqrt(18.0), 1e-14);
  EXPECT_NEAR(effects.factors[1].mu, -1.5, 1e-14);
  EXPECT_NEAR(effects.factors[1].mu_star.value, 4.5, 1e-14);
  EXPECT_NEAR(*effects.factors[1].sigma, std::sqrt(40.5), 1e-14);
}

TEST(MorrisEffects, TellInteractionFromNoInfluence) {
  // The effect of a factor is what the other one deviates by: -1/2, -1/6, 1/6 or 1/2.
  const Eigen::MatrixXd cells = morris(400, 3);
  const Function product = [](const auto& x) { return (x[0] - 0.5) * (x[1] - 0.5); };
  const MorrisEffects effects = morris_effects(cells, answers(cells, product));
  for (const std::size_t i : {0U, 1U}) {
    const MorrisEffect& effect = effects.factors[i];
    const double sigma = std::sqrt((0.25 + 1.0 / 36.0) / 2.0);
    EXPECT_NEAR(effect.mu, 0.0, 4.0 * sigma / std::sqrt(400.0));
    EXPECT_NEAR(effect.mu_star.value, 1.0 / 3.0, 4.0 * (1.0 / 6.0) / std::sqrt(400.0));
    EXPECT_NEAR(*effect.sigma, sigma, 0.04);
    EXPECT_LE(effect.mu_star.interval->low, 1.0 / 3.0);
    EXPECT_GE(effect.mu_star.interval->high, 1.0 / 3.0);
  }
  EXPECT_EQ(effects.factors[2].mu_star.value, 0.0);
  EXPECT_FALSE(effects.factors[2].mu_star.distinguishable());
}

TEST(MorrisEffects, LeaveOutATrajectoryWithAMissingAnswerAsAWhole) {
  const Eigen::MatrixXd cells = morris(5, 3);
  const List all = answers(cells, ishigami(7.0, 0.1).f);
  Eigen::MatrixXd shorter(16, 3);
  shorter << cells.topRows(8), cells.bottomRows(8);
  List rest = all;
  rest.erase(rest.begin() + 8, rest.begin() + 12);
  const MorrisEffects without = morris_effects(shorter, rest);
  for (const std::size_t missing : {8U, 9U, 11U}) {
    List gappy = all;
    gappy[missing] = std::nullopt;
    const MorrisEffects left = morris_effects(cells, gappy);
    EXPECT_EQ(left.trajectories, 4);
    EXPECT_EQ(left.left_out, 1);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(left.factors[i].mu, without.factors[i].mu);
      EXPECT_EQ(left.factors[i].sigma, without.factors[i].sigma);
      EXPECT_EQ(left.factors[i].mu_star.interval->low, without.factors[i].mu_star.interval->low);
    }
  }
}

TEST(MorrisEffects, OfOneTrajectoryHaveNeitherDeviationNorInterval) {
  const Eigen::MatrixXd cells = morris(1, 2);
  const MorrisEffects effects = morris_effects(cells, answers(cells, linear({1.0, 2.0}).f));
  EXPECT_NEAR(effects.factors[1].mu, 2.0, 1e-14);
  EXPECT_EQ(effects.factors[1].sigma, std::nullopt);
  EXPECT_EQ(effects.factors[1].mu_star.interval, std::nullopt);
}

TEST(MorrisEffects, AreNotDefinedWithoutAWholeTrajectory) {
  const Eigen::MatrixXd cells = morris(2, 2);
  List y(6, 1.0);
  y[0] = y[5] = std::nullopt;
  const MorrisEffects effects = morris_effects(cells, y);
  EXPECT_EQ(effects.left_out, 2);
  EXPECT_TRUE(effects.factors.empty());
  EXPECT_NE(effects.undefined, "");
}

TEST(MorrisEffects, RefuseCellsThatAreNoTrajectories) {
  const Eigen::MatrixXd cells = morris(2, 2);
  EXPECT_THROW(morris_effects(cells, List(5, 1.0)), std::invalid_argument);
  EXPECT_THROW(morris_effects(cells.topRows(5), List(5, 1.0)), std::invalid_argument);

  Eigen::MatrixXd both(3, 2), twice(3, 2);
  both << 0.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  twice << 0.0, 0.0, 1.0, 0.0, 0.0, 0.0;
  EXPECT_THROW(morris_effects(both, List(3, 1.0)), std::invalid_argument);
  EXPECT_THROW(morris_effects(twice, List(3, 1.0)), std::invalid_argument);

  List infinite(6, 1.0);
  infinite[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(morris_effects(cells, infinite), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis
