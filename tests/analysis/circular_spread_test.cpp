#include "shoal/analysis/experiments/measures/circular_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace shoal::analysis {
namespace {

using Angles = std::vector<double>;
constexpr double circle = 2.0 * std::numbers::pi;

TEST(CircularSpread, OfEqualAnglesIsZero) {
  EXPECT_NEAR(*circular_spread(Angles{0.3, 0.3, 0.3}, 1), 0.0, 1e-7);  // sqrt of a rounding
}

TEST(CircularSpread, OfTwoAnglesFollowsFromTheirMeanResultant) {
  // The resultant of +-a is cos(a).
  EXPECT_NEAR(*circular_spread(Angles{2.0 - 0.7, 2.0 + 0.7}, 1),
              std::sqrt(-2.0 * std::log(std::cos(0.7))), 1e-12);
}

TEST(CircularSpread, OfAnglesCloseTogetherIsTheirStandardDeviation) {
  const Angles angles = {0.01, -0.02, 0.03, 0.0, -0.02};  // of mean zero
  EXPECT_NEAR(*circular_spread(angles, 1), std::sqrt(18e-4 / 5.0), 1e-5);
  EXPECT_NEAR(*circular_spread(angles, 6), std::sqrt(18e-4 / 5.0), 1e-4);
}

TEST(CircularSpread, DoesNotSeeTurnsOfTheLatticeOntoItself) {
  for (const int order : {1, 2, 4, 6}) {
    const Angles angles = {0.1, 0.15, 0.22, 0.05};
    Angles turned = angles;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      turned[i] += static_cast<double>(i) * circle / order + 1.0;
    }
    EXPECT_NEAR(*circular_spread(turned, order), *circular_spread(angles, order), 1e-9) << order;
  }
}

TEST(CircularSpread, SeesAQuarterTurnOfAHexagonalLattice) {
  EXPECT_LT(*circular_spread(Angles{0.0, circle / 4}, 4), 1e-6);
  EXPECT_GT(*circular_spread(Angles{0.0, circle / 4}, 6), 0.5);
}

TEST(CircularSpread, NeedsTwoAngles) {
  EXPECT_EQ(circular_spread(Angles{}, 4), std::nullopt);
  EXPECT_EQ(circular_spread(Angles{1.0}, 4), std::nullopt);
}

}  // namespace
}  // namespace shoal::analysis
