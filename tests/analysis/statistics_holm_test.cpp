#include "shoal/analysis/statistics/holm.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

TEST(Holm, StepsDownFromTheSmallest) {
  // By hand: 4 x 0.005, 3 x 0.01, 2 x 0.03 and, held up by it, 1 x 0.04.
  const std::vector<double> adjusted = holm(std::vector{0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected{0.03, 0.06, 0.06, 0.02};
  ASSERT_EQ(adjusted.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], expected[i]);
}

TEST(Holm, GivesEqualPValuesEqualAnswersAndNoneAboveOne) {
  EXPECT_EQ(holm(std::vector{0.25, 0.25, 0.25}), (std::vector{0.75, 0.75, 0.75}));
  EXPECT_EQ(holm(std::vector{0.9, 0.0, 0.5}), (std::vector{1.0, 0.0, 1.0}));
}

TEST(Holm, OfOneIsItselfAndOfNoneNothing) {
  EXPECT_EQ(holm(std::vector{0.3}), std::vector{0.3});
  EXPECT_TRUE(holm({}).empty());
}

TEST(Holm, RefusesWhatIsNoPValue) {
  for (const double bad : {-0.01, 1.01, std::nan("")}) {
    EXPECT_THROW(holm(std::vector{0.5, bad}), std::invalid_argument);
  }
}

TEST(Holm, KeepsTheOrderAndLiesBetweenNoCorrectionAndBonferroni) {
  EXPECT_TRUE(rc::check("order", [](const std::vector<std::uint8_t>& bytes) {
    std::vector<double> p;
    for (const std::uint8_t byte : bytes) p.push_back(byte / 255.0);
    const std::vector<double> adjusted = holm(p);
    RC_ASSERT(adjusted.size() == p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      RC_ASSERT(adjusted[i] >= p[i]);
      RC_ASSERT(adjusted[i] <= std::min(1.0, static_cast<double>(p.size()) * p[i]));
      for (std::size_t j = 0; j < p.size(); ++j)
        RC_ASSERT(p[i] > p[j] || adjusted[i] <= adjusted[j]);
    }
  }));
}

}  // namespace
}  // namespace shoal::analysis::statistics
