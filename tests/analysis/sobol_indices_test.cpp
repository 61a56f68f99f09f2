#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/core/random.hpp"
#include "tests/analysis/sensitivity_functions.hpp"

namespace shoal::analysis {
namespace {

using namespace test;  // NOLINT: the functions are few, and all of them are meant

using List = std::vector<std::optional<double>>;

SobolIndices indices_of_one_seed(const List& of_one_seed, int factors,
                                 const Resampling& resampling = {}) {
  return sobol_indices({of_one_seed}, {factors}, resampling);
}

std::vector<SobolIndices> convergence_of_one_seed(const List& of_one_seed, int factors) {
  return sobol_convergence({of_one_seed}, {factors});
}

/// That all indices of `known` from N base samples lie within `bound` of the truth, and the truth
/// within their intervals.
void expect_known(const Known& known, std::int64_t base_samples, double bound) {
  const int k = static_cast<int>(known.total.size());
  const List y = answers(saltelli(base_samples, k), known.f);
  const SobolIndices indices = indices_of_one_seed(y, k);
  EXPECT_EQ(indices.base_samples, base_samples);
  EXPECT_EQ(indices.left_out, 0);
  EXPECT_EQ(indices.undefined, "");
  ASSERT_EQ(indices.factors.size(), known.total.size());
  for (std::size_t i = 0; i < known.total.size(); ++i) {
    const auto& [first_order, total] = indices.factors[i];
    EXPECT_NEAR(first_order.value, known.first_order[i], bound) << "S" << i + 1;
    EXPECT_NEAR(total.value, known.total[i], bound) << "T" << i + 1;
    EXPECT_TRUE(covers(first_order, known.first_order[i])) << "S" << i + 1;
    EXPECT_TRUE(covers(total, known.total[i])) << "T" << i + 1;
  }
}

TEST(KnownFunctions, HaveThePublishedIndices) {
  // Saltelli et al. 2008, Global Sensitivity Analysis: The Primer, ch. 4, exercise 5.
  const Known f = ishigami(7.0, 0.1);
  const std::vector<double> first = {0.31390519, 0.44241114, 0.0};
  const std::vector<double> total = {0.55758886, 0.44241114, 0.24368366};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(f.first_order[i], first[i], 5e-9);
    EXPECT_NEAR(f.total[i], total[i], 5e-9);
  }
}

TEST(SobolIndices, OfIshigamiAreTheAnalyticOnes) {
  expect_known(ishigami(7.0, 0.1), 4096, 0.003);
  expect_known(ishigami(7.0, 0.1), 16384, 0.002);
}

TEST(SobolIndices, OfSobolsGAreTheAnalyticOnes) {
  expect_known(sobol_g({0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0}), 4096, 0.003);
  expect_known(sobol_g({0.0, 0.5, 3.0, 9.0, 99.0, 99.0}), 4096, 0.003);
  expect_known(sobol_g({0.0, 0.0, 0.0}), 16384, 0.005);
  expect_known(sobol_g({6.52, 6.52, 6.52, 6.52}), 4096, 0.001);
}

TEST(SobolIndices, OfASumAreTheSharesOfItsTerms) {
  expect_known(linear({1.0, 2.0, -3.0}), 4096, 0.0002);
}

// Two factors, two base samples: A = 0, AB_1 = 1, AB_2 = 2, B = 4, and A = 2, AB_1 = 2, AB_2 = 0,
// B = 2. The mean of A and B is 2, their variance (4 + 4 + 0 + 0) / 4 = 2.
const List by_hand = {0.0, 1.0, 2.0, 4.0, 2.0, 2.0, 0.0, 2.0};

TEST(SobolIndices, AreTheEstimatorsOfTheLiteratureOnCentredAnswers) {
  const SobolIndices indices = indices_of_one_seed(by_hand, 2);
  ASSERT_EQ(indices.factors.size(), 2U);
  // Saltelli: ((4-2)(1-0) + (2-2)(2-2)) / 2 / 2; Jansen: ((1-0)^2 + (2-2)^2) / 4 / 2.
  EXPECT_DOUBLE_EQ(indices.factors[0].first_order.value, 0.5);
  EXPECT_DOUBLE_EQ(indices.factors[0].total.value, 0.125);
  // ((4-2)(2-0) + (2-2)(0-2)) / 2 / 2, ((2-0)^2 + (0-2)^2) / 4 / 2.
  EXPECT_DOUBLE_EQ(indices.factors[1].first_order.value, 1.0);
  EXPECT_DOUBLE_EQ(indices.factors[1].total.value, 1.0);
}

TEST(SobolIndices, DoNotDependOnOriginAndUnitOfTheAnswer) {
  const Known g = sobol_g({0.0, 1.0, 4.5});
  const Eigen::MatrixXd cells = saltelli(256, 3);
  const SobolIndices plain = indices_of_one_seed(answers(cells, g.f), 3);
  const SobolIndices other =
      indices_of_one_seed(answers(cells, [&](const auto& x) { return 1e6 - 50.0 * g.f(x); }), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    // 1e6 keeps nine or ten digits of the answers.
    const auto& [first_order, total] = plain.factors[i];
    EXPECT_NEAR(other.factors[i].first_order.value, first_order.value, 1e-9);
    EXPECT_NEAR(other.factors[i].first_order.interval->low, first_order.interval->low, 1e-9);
    EXPECT_NEAR(other.factors[i].total.value, total.value, 1e-9);
    EXPECT_NEAR(other.factors[i].total.interval->high, total.interval->high, 1e-9);
  }
}

TEST(SobolIndices, OfAFactorWithoutInfluenceAreZeroAndNotDistinguishable) {
  const Known known = linear({1.0, 0.0, 2.0});
  const SobolIndices indices = indices_of_one_seed(answers(saltelli(256, 3), known.f), 3);
  EXPECT_EQ(indices.factors[1].first_order.value, 0.0);
  EXPECT_EQ(indices.factors[1].total.value, 0.0);
  EXPECT_FALSE(indices.factors[1].first_order.distinguishable());
  EXPECT_FALSE(indices.factors[1].total.distinguishable());
  EXPECT_TRUE(indices.factors[0].first_order.distinguishable());
  EXPECT_TRUE(indices.factors[0].total.distinguishable());
}

TEST(SobolIndices, OfAPureInteractionAreTotalOnly) {
  const Function product = [](const auto& x) { return (x[0] - 0.5) * (x[1] - 0.5); };
  const SobolIndices indices = indices_of_one_seed(answers(saltelli(4096, 2), product), 2);
  for (const auto& [first_order, total] : indices.factors) {
    EXPECT_FALSE(first_order.distinguishable());
    EXPECT_NEAR(total.value, 1.0, 0.02);
  }
}

TEST(SobolIndices, LeaveOutABaseSampleWithAMissingAnswerAsAWhole) {
  const Known known = linear({1.0, 2.0});
  const List all = answers(saltelli(64, 2), known.f);
  for (const std::size_t missing : {0U, 1U, 2U, 3U}) {  // A, AB_1, AB_2, B
    List gappy = all, shorter = all;
    gappy[20 + missing] = std::nullopt;
    shorter.erase(shorter.begin() + 20, shorter.begin() + 24);
    const SobolIndices left = indices_of_one_seed(gappy, 2),
                       without = indices_of_one_seed(shorter, 2);
    EXPECT_EQ(left.base_samples, 63);
    EXPECT_EQ(left.left_out, 1);
    EXPECT_EQ(without.left_out, 0);
    EXPECT_EQ(left.factors[0].total.value, without.factors[0].total.value);
    EXPECT_EQ(left.factors[1].first_order.interval->low,
              without.factors[1].first_order.interval->low);
  }
}

TEST(SobolIndices, OfAnswersThatDoNotVaryAreNotDefined) {
  const SobolIndices constant = indices_of_one_seed(List(64, 0.1), 2);
  EXPECT_EQ(constant.base_samples, 16);
  EXPECT_TRUE(constant.factors.empty());
  EXPECT_EQ(constant.undefined, "the answers to the base samples do not vary");

  List rounded(64, 33.82);
  rounded[3] = std::nextafter(33.82, 40.0);
  EXPECT_EQ(indices_of_one_seed(rounded, 2).undefined,
            "the answers to the base samples do not vary");
}

TEST(SobolIndices, OfOneBaseSampleAreNotDefined) {
  const SobolIndices one = indices_of_one_seed(List{0.0, 1.0, 2.0, 4.0}, 2);
  EXPECT_EQ(one.base_samples, 1);
  EXPECT_TRUE(one.factors.empty());
  EXPECT_NE(one.undefined, "");

  const SobolIndices none = indices_of_one_seed(List(8, std::nullopt), 2);
  EXPECT_EQ(none.base_samples, 0);
  EXPECT_EQ(none.left_out, 2);
  EXPECT_NE(none.undefined, "");
}

TEST(SobolIndices, HaveNoIntervalWhereAResampleDoesNotVary) {
  // Drawn alone, the second base sample of these, 2 and 2, has no variance.
  const SobolIndices indices = indices_of_one_seed(by_hand, 2);
  for (const auto& [first_order, total] : indices.factors) {
    EXPECT_EQ(first_order.interval, std::nullopt);
    EXPECT_FALSE(total.distinguishable());
  }
}

TEST(SobolIndices, RefuseAnswersThatAreNoDesign) {
  EXPECT_THROW(indices_of_one_seed(List(7, 1.0), 2), std::invalid_argument);
  EXPECT_THROW(indices_of_one_seed(List(8, 1.0), 0), std::invalid_argument);
  List infinite = by_hand;
  infinite[2] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(indices_of_one_seed(infinite, 2), std::invalid_argument);
  EXPECT_THROW(indices_of_one_seed(by_hand, 2, {.level = 1.0}), std::invalid_argument);
  EXPECT_THROW(indices_of_one_seed(by_hand, 2, {.resamples = 0}), std::invalid_argument);
}

TEST(SobolIndices, AreTheSameBitsAgainAndOfAnotherSeedHaveOtherIntervals) {
  const List y = answers(saltelli(64, 2), linear({1.0, 2.0}).f);
  const IndexEstimate once = indices_of_one_seed(y, 2).factors[0].total;
  EXPECT_EQ(once.interval->low, indices_of_one_seed(y, 2).factors[0].total.interval->low);
  EXPECT_NE(once.interval->low,
            indices_of_one_seed(y, 2, {.seed = 2}).factors[0].total.interval->low);
}

TEST(SobolConvergence, IsThatOfTheSmallerDesigns) {
  const Known known = ishigami(7.0, 0.1);
  const List y = answers(saltelli(1024, 3), known.f);
  const std::vector<SobolIndices> steps = convergence_of_one_seed(y, 3);
  ASSERT_EQ(steps.size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    const int n = 128 << s;
    EXPECT_EQ(steps[s].base_samples, n);
    const SobolIndices smaller = indices_of_one_seed(answers(saltelli(n, 3), known.f), 3);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(steps[s].factors[i].total.value, smaller.factors[i].total.value);
      EXPECT_EQ(steps[s].factors[i].first_order.interval->high,
                smaller.factors[i].first_order.interval->high);
    }
  }
}

TEST(SobolConvergence, CountsWhatIsMissingInEachPart) {
  List y = answers(saltelli(16, 2), linear({1.0, 2.0}).f);
  y[12] = std::nullopt;
  const std::vector<SobolIndices> steps = convergence_of_one_seed(y, 2);
  ASSERT_EQ(steps.size(), 4U);
  const std::vector<int> left_out = {0, 1, 1, 1};
  for (std::size_t s = 0; s < 4; ++s) EXPECT_EQ(steps[s].left_out, left_out[s]);
}

TEST(SobolConvergence, BeginsWithOneBaseSampleOfFew) {
  const std::vector<SobolIndices> steps =
      convergence_of_one_seed(answers(saltelli(4, 2), linear({1.0, 2.0}).f), 2);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_NE(steps[0].undefined, "");
  EXPECT_EQ(steps[2].base_samples, 4);
}

TEST(SobolIntervals, AreThoseOfTheEstimatorItself) {
  // Of three base samples there are 27 resamples, each of which has a part of 1/27 at least; at the
  // highest level the interval spans their estimates.
  const std::vector<List> samples = {
      {0.0, 1.0, 2.5, 4.0}, {3.0, 2.0, 0.5, 1.0}, {7.0, 6.5, 5.0, -1.0}};
  std::vector<double> first_order, total;
  for (int r = 0; r < 27; ++r) {
    List y;
    for (const int drawn : {r % 3, r / 3 % 3, r / 9}) {
      const List& sample = samples[static_cast<std::size_t>(drawn)];
      y.insert(y.end(), sample.begin(), sample.end());
    }
    const SobolIndices indices = indices_of_one_seed(y, 2, {.resamples = 1});
    first_order.push_back(indices.factors[0].first_order.value);
    total.push_back(indices.factors[0].total.value);
  }
  List y;
  for (const List& sample : samples) y.insert(y.end(), sample.begin(), sample.end());
  const SobolIndices indices = indices_of_one_seed(y, 2, {.level = 0.999999});
  const auto& [s, t] = indices.factors[0];
  EXPECT_NEAR(s.interval->low, *std::ranges::min_element(first_order), 1e-12);
  EXPECT_NEAR(s.interval->high, *std::ranges::max_element(first_order), 1e-12);
  EXPECT_NEAR(t.interval->low, *std::ranges::min_element(total), 1e-12);
  EXPECT_NEAR(t.interval->high, *std::ranges::max_element(total), 1e-12);
}

/// How often, of 200 studies with 128 base samples each, the intervals hold the truth.
std::vector<int> coverage(const Known& known,
                          const std::function<Eigen::MatrixXd(std::uint64_t seed)>& design) {
  const int k = static_cast<int>(known.total.size());
  std::vector<int> covered(2 * known.total.size(), 0);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const List y = answers(design(seed), known.f);
    const SobolIndices indices = indices_of_one_seed(y, k, {.resamples = 300, .seed = seed});
    for (std::size_t i = 0; i < known.total.size(); ++i) {
      const auto& [first_order, total] = indices.factors[i];
      covered[2 * i] += covers(first_order, known.first_order[i]) ? 1 : 0;
      covered[2 * i + 1] += covers(total, known.total[i]) ? 1 : 0;
    }
  }
  return covered;
}

TEST(SobolIntervals, HoldTheTruthAboutAsOftenAsTheySayForIndependentSamples) {
  const auto independent = [](std::uint64_t seed) {
    const RandomStreams random(seed);
    Eigen::MatrixXd cells(128 * 5, 3);
    for (Eigen::Index j = 0; j < 128; ++j) {
      auto block = cells.middleRows(5 * j, 5);
      for (Eigen::Index f = 0; f < 3; ++f) {
        const auto [a, b] = random.uniform(Purpose::start, static_cast<std::uint32_t>(f),
                                           static_cast<std::uint64_t>(j));
        block.col(f).setConstant(a);
        block(1 + f, f) = block(4, f) = b;
      }
    }
    return cells;
  };
  for (const int covered : coverage(sobol_g({0.0, 1.0, 4.5}), independent)) {
    EXPECT_NEAR(covered, 190, 4 * 3.1);  // four standard deviations of the binomial
  }
}

TEST(SobolIntervals, AreOnTheSafeSideForTheDesign) {
  const auto design = [](std::uint64_t seed) {
    return saltelli(128, 3, static_cast<std::int64_t>(seed));
  };
  for (const int covered : coverage(sobol_g({0.0, 1.0, 4.5}), design)) EXPECT_GE(covered, 190);
}

}  // namespace
}  // namespace shoal::analysis
