#include "shoal/analysis/statistics/sensitivity/shapley.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace shoal::analysis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// By the definition: the marginal contributions over all orders, one after the other.
VectorXd over_all_orders(const VectorXd& worths, int players) {
  std::vector<int> order(static_cast<std::size_t>(players));
  std::iota(order.begin(), order.end(), 0);
  VectorXd sum = VectorXd::Zero(players);
  int orders = 0;
  do {
    Index coalition = 0;
    for (const int player : order) {
      const Index with = coalition | (Index{1} << player);
      sum[player] += worths[with] - worths[coalition];
      coalition = with;
    }
    ++orders;
  } while (std::ranges::next_permutation(order).found);
  return sum / orders;
}

VectorXd random_worths(int players, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(3.0, 10.0);
  VectorXd worths(Index{1} << players);
  for (double& worth : worths) worth = normal(random);
  return worths;
}

template <class Function>
VectorXd game(int players, const Function& f) {
  VectorXd worths(Index{1} << players);
  for (Index c = 0; c < worths.size(); ++c) worths[c] = f(c);
  return worths;
}

bool takes_part(Index coalition, int player) {
  return (coalition >> player & 1) != 0;
}

TEST(Shapley, OfASumAreItsTerms) {
  const VectorXd terms{{1.5, -2.0, 0.0, 40.0}};
  const VectorXd worths = game(4, [&](Index c) {
    double sum = 7.0;
    for (int i = 0; i < 4; ++i) sum += takes_part(c, i) ? terms[i] : 0.0;
    return sum;
  });
  EXPECT_LT((shapley_values(worths) - terms).norm(), 1e-12);
}

TEST(Shapley, APureInteractionIsSplitEqually) {
  // Only all three together do anything; the fourth is a dummy.
  const VectorXd worths = game(4, [](Index c) { return (c & 7) == 7 ? 12.0 : 0.0; });
  EXPECT_LT((shapley_values(worths) - VectorXd{{4.0, 4.0, 4.0, 0.0}}).norm(), 1e-12);
}

TEST(Shapley, TheGloveGameByHand) {
  // Player 0 has a left glove, 1 and 2 right ones; a pair is worth 1: 2/3, 1/6, 1/6.
  const VectorXd worths =
      game(3, [](Index c) { return takes_part(c, 0) && (c & 6) != 0 ? 1.0 : 0.0; });
  EXPECT_LT((shapley_values(worths) - VectorXd{{2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0}}).norm(), 1e-14);
}

TEST(Shapley, AgreeWithTheDefinitionAndAddUp) {
  for (int players = 1; players <= 6; ++players) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const VectorXd worths = random_worths(players, seed);
      const VectorXd values = shapley_values(worths);
      EXPECT_LT((values - over_all_orders(worths, players)).norm(), 1e-11);
      EXPECT_NEAR(values.sum(), worths[worths.size() - 1] - worths[0], 1e-11);
    }
  }
}

TEST(Shapley, DoNotDependOnTheNamesOfThePlayers) {
  const int players = 5;
  const VectorXd worths = random_worths(players, 9);
  const std::vector<int> renamed{3, 0, 4, 1, 2};
  const VectorXd others = game(players, [&](Index c) {
    Index own = 0;
    for (int i = 0; i < players; ++i) {
      if (takes_part(c, renamed[static_cast<std::size_t>(i)])) own |= Index{1} << i;
    }
    return worths[own];
  });
  const VectorXd values = shapley_values(worths), renamed_values = shapley_values(others);
  for (int i = 0; i < players; ++i) {
    EXPECT_NEAR(renamed_values[renamed[static_cast<std::size_t>(i)]], values[i], 1e-12);
  }
}

TEST(Shapley, RefuseWorthsThatAreNoGame) {
  EXPECT_THROW(shapley_values(VectorXd::Zero(6)), std::invalid_argument);
  EXPECT_THROW(shapley_values(VectorXd::Zero(0)), std::invalid_argument);
}

using List = std::vector<std::optional<double>>;

TEST(ShapleyAttribution, OfTwoFactorsAndThreeSeedsByHand) {
  // Cells: none, a, b, both.
  const List answers{10.0, 12.0, 11.0, 17.0,  //
                     20.0, 23.0, 20.0, 27.0,  //
                     30.0, 31.0, 31.0, 35.0};
  const ShapleyAttribution result = shapley_attribution(answers, 2);
  EXPECT_EQ(result.seeds, 3);
  EXPECT_EQ(result.left_out, 0);
  EXPECT_NEAR(result.before.value, 20.0, 1e-12);
  EXPECT_NEAR(result.after.value, 79.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.together.value, 19.0 / 3.0, 1e-12);
  ASSERT_EQ(result.factors.size(), 2U);
  // Of a: (2 + 6) / 2, (3 + 7) / 2, (1 + 4) / 2; of b: (1 + 5) / 2, (0 + 4) / 2, (1 + 4) / 2.
  const double mean_a = (4.0 + 5.0 + 2.5) / 3.0;
  EXPECT_NEAR(result.factors[0].share.value, mean_a, 1e-12);
  EXPECT_NEAR(result.factors[1].share.value, (3.0 + 2.0 + 2.5) / 3.0, 1e-12);
  EXPECT_NEAR(result.factors[0].alone.value, 2.0, 1e-12);
  EXPECT_NEAR(result.factors[0].last.value, 17.0 / 3.0, 1e-12);
  // Student's with 2 degrees of freedom: t = 4.30265.
  const double sd = std::sqrt(
      (std::pow(4.0 - mean_a, 2) + std::pow(5.0 - mean_a, 2) + std::pow(2.5 - mean_a, 2)) / 2.0);
  const auto& interval = result.factors[0].share.interval;
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->high - mean_a, 4.302653 * sd / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(result.factors[0].share.value + result.factors[1].share.value, result.together.value,
              1e-12);
}

TEST(ShapleyAttribution, LeavesOutASeedOfWhichAnAnswerIsMissing) {
  const List answers{0.0, 1.0, 2.0, 3.0, 100.0, std::nullopt, 7.0, 8.0, 0.0, 3.0, 2.0, 5.0};
  const ShapleyAttribution result = shapley_attribution(answers, 2);
  EXPECT_EQ(result.seeds, 2);
  EXPECT_EQ(result.left_out, 1);
  EXPECT_NEAR(result.factors[0].share.value, 2.0, 1e-12);
  EXPECT_NEAR(result.factors[1].share.value, 2.0, 1e-12);
  EXPECT_TRUE(result.factors[0].share.distinguishable() == false);
  EXPECT_FALSE(result.factors[1].share.interval);  // does not scatter
}

TEST(ShapleyAttribution, SaysWhyThereIsNone) {
  const List answers{0.0, std::nullopt};
  const ShapleyAttribution result = shapley_attribution(answers, 1);
  EXPECT_EQ(result.undefined, "no seed has all its answers");
  EXPECT_TRUE(result.factors.empty());
  EXPECT_THROW(shapley_attribution(List{0.0, 1.0, 2.0}, 1), std::invalid_argument);
  EXPECT_THROW(shapley_attribution(List{}, 0), std::invalid_argument);
  const List wild{0.0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(shapley_attribution(wild, 1), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis
