#include "shoal/analysis/statistics/paired_tests.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/signed_ranks.hpp"
#include "tests/analysis/sleep_hours.hpp"

namespace shoal::analysis::statistics {
namespace {

using enum Alternative;

/// Darwin 1876: crossed less self-fertilised Zea mays, in eighths of an inch.
const std::vector<double> darwin{49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};

/// Hollander and Wolfe 1973, p. 29: depression before less after the first therapy.
const std::vector<double> depression{1.83 - 0.878, 0.50 - 0.647, 1.62 - 0.598,
                                     2.48 - 2.05,  1.68 - 1.06,  1.88 - 1.29,
                                     1.55 - 1.06,  3.06 - 3.14,  1.30 - 1.29};

std::vector<double> negated(std::vector<double> values) {
  for (double& x : values) x = -x;
  return values;
}

std::vector<double> whole_numbers(int from, int to) {
  std::vector<double> values(static_cast<std::size_t>(to - from + 1));
  std::iota(values.begin(), values.end(), from);
  return values;
}

/// The share of the sign patterns of a few differences that is as far out, pattern by pattern.
double all_patterns(const std::vector<double>& differences, Alternative alternative) {
  const double observed = std::accumulate(differences.begin(), differences.end(), 0.0);
  int as_far_out = 0;
  const unsigned patterns = 1u << differences.size();
  for (unsigned pattern = 0; pattern < patterns; ++pattern) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      sum += (pattern >> i & 1u) != 0 ? differences[i] : -differences[i];
    }
    const bool counts = alternative == greater ? sum >= observed - 1e-9
                        : alternative == less  ? sum <= observed + 1e-9
                                               : std::abs(sum) >= std::abs(observed) - 1e-9;
    as_far_out += counts ? 1 : 0;
  }
  return as_far_out / static_cast<double>(patterns);
}

std::vector<double> some_differences() {
  const auto tenths = *rc::gen::container<std::vector<int>>(
      static_cast<std::size_t>(*rc::gen::inRange(1, 11)), rc::gen::inRange(-12, 13));
  std::vector<double> differences;
  for (const int x : tenths) differences.push_back(x / 10.0);
  return differences;
}

TEST(SignFlipTest, IsThatOfFisherForDarwinsMaize) {
  // Fisher 1935, sec. 21: 863 of the 32768 sums are 314 or more.
  const TestResult one_sided = sign_flip_test(darwin, greater).value();
  EXPECT_EQ(one_sided.p_value, 863.0 / 32768.0);
  EXPECT_DOUBLE_EQ(one_sided.statistic, 314.0 / 15.0);
  EXPECT_EQ(one_sided.n, 15);
  EXPECT_TRUE(one_sided.exact);
  EXPECT_EQ(sign_flip_test(darwin).value().p_value, 2.0 * 863.0 / 32768.0);
}

TEST(SignFlipTest, CountsWhatAPlainLoopOverAllPatternsCounts) {
  EXPECT_TRUE(rc::check("all patterns", [] {
    const std::vector<double> differences = some_differences();  // sums tie, but for rounding
    for (const Alternative alternative : {two_sided, greater, less}) {
      RC_ASSERT(sign_flip_test(differences, alternative).value().p_value ==
                all_patterns(differences, alternative));
    }
  }));
}

TEST(SignFlipTest, OfSignedRanksIsTheSignedRankTest) {
  // Of 32 differences it still counts all 2^32 patterns; of 60 it draws some, with a standard error
  // of sqrt(p (1 - p) / 99999), of which 4 are allowed.
  for (const int n : {11, 32, 60}) {
    std::vector<double> ranks = whole_numbers(1, n);
    for (std::size_t i = 0; i < ranks.size(); i += 3) ranks[i] = -ranks[i];
    for (const Alternative alternative : {two_sided, greater, less}) {
      const TestResult flips = sign_flip_test(ranks, alternative).value();
      const double p = signed_rank_test(ranks, alternative).value().p_value;
      EXPECT_EQ(flips.exact, n <= 32);
      EXPECT_NEAR(flips.p_value, p, n <= 32 ? 1e-12 : 4.0 * std::sqrt(p * (1.0 - p) / 99'999.0));
    }
  }
}

TEST(SignFlipTest, OfManyDifferencesDependsOnItsSeedAndIsNeverZero) {
  std::vector<double> some = whole_numbers(-20, 40);
  EXPECT_EQ(sign_flip_test(some, greater, {.seed = 5}).value().p_value,
            sign_flip_test(some, greater, {.seed = 5}).value().p_value);
  EXPECT_NE(sign_flip_test(some, greater, {.seed = 5}).value().p_value,
            sign_flip_test(some, greater, {.seed = 6}).value().p_value);
  // More than 106: their signs take more than one draw. No pattern but their own comes near.
  const std::vector<double> all_above = whole_numbers(1, 250);
  EXPECT_EQ(sign_flip_test(all_above, greater, {.resamples = 999}).value().p_value, 1.0 / 1000.0);
  EXPECT_EQ(sign_flip_test(all_above, less, {.resamples = 999}).value().p_value, 1.0);
}

TEST(SignFlipTest, FindsNothingInDifferencesOfZero) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{5}, std::size_t{50}}) {
    for (const Alternative alternative : {two_sided, greater, less}) {
      EXPECT_EQ(sign_flip_test(std::vector<double>(n), alternative).value().p_value, 1.0);
    }
  }
}

TEST(SignedRankTest, IsThatOfHollanderAndWolfeForDepression) {
  const TestResult result = signed_rank_test(depression, greater).value();
  EXPECT_EQ(result.statistic, 40.0);
  EXPECT_EQ(result.p_value, 10.0 / 512.0);  // 0.01953
  EXPECT_EQ(result.n, 9);
  EXPECT_TRUE(result.exact);
}

TEST(SignedRankTest, GivesEqualDifferencesTheirMidrankAndLeavesOutZeros) {
  // Without the 0, the ranks are 1.5, 1.5 and 3: of the 8 sums only 6 and 4.5 (twice) reach 4.5.
  const std::vector<double> tied{0.0, 1.0, -1.0, 2.0};
  const TestResult result = signed_rank_test(tied, greater).value();
  EXPECT_EQ(result.statistic, 4.5);
  EXPECT_EQ(result.n, 3);
  EXPECT_EQ(result.p_value, 3.0 / 8.0);
  EXPECT_EQ(signed_rank_test(tied, less).value().p_value, 7.0 / 8.0);
  EXPECT_EQ(signed_rank_test(tied).value().p_value, 6.0 / 8.0);
}

TEST(SignedRankTest, OfManyIsNormalWithACorrectionForContinuity) {
  std::vector<double> differences = whole_numbers(1, 120);  // their own ranks
  double positive = 0.0;
  for (double& x : differences) {
    if (std::fmod(x, 5.0) < 2.0) x = -x;
    positive += std::max(0.0, x);
  }
  const double n = 120.0;
  const double excess = positive - n * (n + 1.0) / 4.0;
  const double z = (excess - 0.5) / std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
  const TestResult result = signed_rank_test(differences, greater).value();
  EXPECT_FALSE(result.exact);
  EXPECT_NEAR(result.p_value, 0.5 * std::erfc(z / std::sqrt(2.0)), 1e-14);
  EXPECT_NEAR(signed_rank_test(differences).value().p_value, std::erfc(z / std::sqrt(2.0)), 1e-14);
}

TEST(SignedRankTest, IsTheSignFlipTestOfItsSignedRanks) {
  EXPECT_TRUE(rc::check("ranks with ties", [] {
    const std::vector<double> differences = some_differences();
    std::vector<double> ranks;
    for (const SignedRank& rank : signed_ranks(differences)) {
      ranks.push_back(rank.positive ? rank.doubled : -rank.doubled);
    }
    RC_PRE(!ranks.empty());
    for (const Alternative alternative : {two_sided, greater, less}) {
      RC_ASSERT(signed_rank_test(differences, alternative).value().p_value ==
                all_patterns(ranks, alternative));
    }
  }));
}

TEST(SignedRankTest, OfManyDifferencesIsNearlyTheExactOne) {
  // At the change from one to the other, n = 100, the approximation errs by less than 3e-4.
  std::vector<double> ranks = whole_numbers(1, 101);
  for (std::size_t i = 0; i < ranks.size(); i += 3) ranks[i] = -ranks[i];
  const TestResult approximate = signed_rank_test(ranks).value();
  const TestResult sampled = sign_flip_test(ranks).value();
  EXPECT_FALSE(approximate.exact);
  EXPECT_EQ(approximate.statistic, sampled.statistic * 101.0 / 2.0 + 101.0 * 102.0 / 4.0);
  const double p = approximate.p_value;
  EXPECT_NEAR(p, sampled.p_value, 3e-4 + 4.0 * std::sqrt(p * (1.0 - p) / 99'999.0));
}

TEST(SignedRankTest, OfOppositePairsIsOneHalfOnEitherSide) {
  for (const int n : {4, 75}) {  // 8 and 150 differences: exact and approximate
    std::vector<double> balanced = whole_numbers(1, n);
    for (int i = 1; i <= n; ++i) balanced.push_back(-i);
    EXPECT_EQ(signed_rank_test(balanced).value().p_value, 1.0);
    EXPECT_GE(signed_rank_test(balanced, greater).value().p_value, 0.5);
    EXPECT_EQ(signed_rank_test(balanced, greater).value().p_value,
              signed_rank_test(balanced, less).value().p_value);
  }
}

TEST(PairedTTest, IsThatOfStudentsSleepers) {
  const TestResult result = paired_t_test(sleep_hours).value();
  EXPECT_NEAR(result.statistic, -4.0621, 5e-5);
  EXPECT_NEAR(result.p_value, 0.002833, 5e-7);
  EXPECT_EQ(result.n, 10);
}

TEST(PairedTTest, IsThatOfFisherForDarwinsMaize) {
  EXPECT_NEAR(paired_t_test(darwin).value().statistic, 2.148, 5e-4);  // Fisher 1935, sec. 17
}

TEST(PairedTests, AreUndefinedWithoutDifferences) {
  EXPECT_FALSE(sign_flip_test({}));
  EXPECT_FALSE(signed_rank_test({}));
  EXPECT_FALSE(signed_rank_test(std::vector{0.0, 0.0}));
  EXPECT_FALSE(paired_t_test({}));
  EXPECT_FALSE(paired_t_test(std::vector{1.0}));
  EXPECT_FALSE(paired_t_test(std::vector{1.0, 1.0, 1.0}));
}

TEST(PairedTests, RefuseWhatIsNoNumberAndNoResample) {
  const std::vector<double> bad{1.0, std::nan("")};
  EXPECT_THROW(sign_flip_test(bad), std::invalid_argument);
  EXPECT_THROW(signed_rank_test(bad), std::invalid_argument);
  EXPECT_THROW(paired_t_test(bad), std::invalid_argument);
  EXPECT_THROW(sign_flip_test(darwin, two_sided, {.resamples = 0}), std::invalid_argument);
}

TEST(PairedTests, SeeTheMirrorImageOfNegatedDifferences) {
  EXPECT_TRUE(rc::check("symmetry", [] {
    const std::vector<double> differences = some_differences();
    const std::vector<double> mirrored = negated(differences);
    const auto agree = [&](auto test) {
      const auto p_value = [&](const std::vector<double>& d, Alternative alternative) {
        const std::optional<TestResult> result = test(d, alternative);
        return result ? result->p_value : -1.0;
      };
      RC_ASSERT(p_value(differences, greater) == p_value(mirrored, less));
      RC_ASSERT(p_value(differences, less) == p_value(mirrored, greater));
      RC_ASSERT(p_value(differences, two_sided) == p_value(mirrored, two_sided));
    };
    agree([](Sample d, Alternative alternative) { return sign_flip_test(d, alternative); });
    agree([](Sample d, Alternative alternative) { return signed_rank_test(d, alternative); });
    agree([](Sample d, Alternative alternative) { return paired_t_test(d, alternative); });
  }));
}

}  // namespace
}  // namespace shoal::analysis::statistics
