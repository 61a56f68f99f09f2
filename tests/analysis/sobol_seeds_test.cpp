// Sobol' indices of pairs of factors, and of answers that also depend on a seed.

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"
#include "shoal/core/random.hpp"
#include "tests/analysis/sensitivity_functions.hpp"

namespace shoal::analysis {
namespace {

using namespace test;  // NOLINT: the functions are few, and all of them are meant

void expect_known_pairs(const SobolIndices& indices, const Known& known, double bound) {
  ASSERT_EQ(indices.undefined, "");
  for (std::size_t i = 0; i < known.total.size(); ++i) {
    EXPECT_NEAR(indices.factors[i].first_order.value, known.first_order[i], bound) << "S" << i + 1;
    EXPECT_NEAR(indices.factors[i].total.value, known.total[i], bound) << "T" << i + 1;
    EXPECT_TRUE(covers(indices.factors[i].first_order, known.first_order[i])) << "S" << i + 1;
    EXPECT_TRUE(covers(indices.factors[i].total, known.total[i])) << "T" << i + 1;
  }
  ASSERT_EQ(indices.pairs.size(), known.pairs.size());
  for (std::size_t p = 0; p < known.pairs.size(); ++p) {
    const auto& [first, second, index] = indices.pairs[p];
    EXPECT_NEAR(index.value, known.pairs[p], bound) << first + 1 << ", " << second + 1;
    EXPECT_TRUE(covers(index, known.pairs[p])) << first + 1 << ", " << second + 1;
  }
}

TEST(SobolPairs, OfKnownFunctionsAreTheAnalyticOnes) {
  const Known f = ishigami(7.0, 0.1);
  expect_known_pairs(sobol_indices({answers(saltelli_of_pairs(4096, 3), f.f)}, {3, true}), f,
                     0.005);
  const Known g = sobol_g({0.0, 0.5, 3.0});
  expect_known_pairs(sobol_indices({answers(saltelli_of_pairs(4096, 3), g.f)}, {3, true}), g,
                     0.005);
  const Known sum = linear({1.0, 2.0, -3.0});
  expect_known_pairs(sobol_indices({answers(saltelli_of_pairs(4096, 3), sum.f)}, {3, true}), sum,
                     0.001);
}

// Two factors, two base samples: A, AB_1, AB_2, BA_1, BA_2, B.
TEST(SobolPairs, AreTheEstimatorByHand) {
  const std::vector<std::optional<double>> y{0, 1, 2, 3, 5, 4, 2, 2, 0, 1, 4, 2};
  const SobolIndices indices = sobol_indices({y}, {2, true});
  // Variance of A and B: of 0, 4, 2, 2 about 2, which is 2. (BA_1 - B)(AB_2 - A): (3-4)(2-0) = -2,
  // (1-2)(0-2) = 2; (BA_2 - B)(AB_1 - A): (5-4)(1-0) = 1, (4-2)(2-2) = 0. Mean: 1 / 4.
  ASSERT_EQ(indices.pairs.size(), 1u);
  EXPECT_DOUBLE_EQ(indices.pairs[0].index.value, 0.125);
  // First order of factor 1: b (c - a), centred: 2 * 1, 0 * 0; a (d - b): -2 * -1, 0 * -1.
  EXPECT_DOUBLE_EQ(indices.factors[0].first_order.value, (2.0 + 2.0) / 4.0 / 2.0);
  // Total: (1^2 + 0^2) / 2 and (1^2 + 1^2) / 2 over two samples, averaged.
  EXPECT_DOUBLE_EQ(indices.factors[0].total.value, (0.25 + 0.5) / 2.0 / 2.0);
}

/// What one seed makes of a function: a shift of its own, another slope of the first factor, and
/// noise that is new in every cell.
std::vector<std::optional<double>> under_seed(const Eigen::MatrixXd& cells, const Function& f,
                                              std::uint64_t seed, double slope, double noise) {
  const RandomStreams random(seed);
  const auto normal = [&](std::uint64_t index) {
    const auto [u, v] = random.uniform(Purpose::bootstrap, 7, index);
    return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
  };
  const double shift = 3.0 * normal(0), tilt = slope * normal(1);
  std::vector<std::optional<double>> answers;
  for (Eigen::Index row = 0; row < cells.rows(); ++row) {
    answers.emplace_back(f(cells.row(row)) + shift + tilt * cells(row, 0) +
                         noise * normal(2 + static_cast<std::uint64_t>(row)));
  }
  return answers;
}

AnswersBySeed under_seeds(const Eigen::MatrixXd& cells, const Function& f, std::uint64_t first,
                          int count, double slope, double noise) {
  AnswersBySeed answers;
  for (int k = 0; k < count; ++k) {
    answers.push_back(under_seed(cells, f, first + static_cast<std::uint64_t>(k), slope, noise));
  }
  return answers;
}

TEST(SobolSeeds, NoiseHasNoPartInTheIndicesOfTheMean) {
  const Known g = sobol_g({0.0, 0.5, 3.0});
  const Eigen::MatrixXd cells = saltelli_of_pairs(2048, 3);
  // The noise has about the variance of g itself.
  const AnswersBySeed noisy = under_seeds(cells, g.f, 1, 4, 0.0, 0.6);
  expect_known_pairs(sobol_indices(noisy, {3, true}), g, 0.06);
  // Of one seed it counts as an interaction of all factors.
  EXPECT_GT(sobol_indices({noisy.front()}, {3, true}).factors[2].total.value, 0.35);
}

TEST(SobolSeeds, AShiftOfEachSeedChangesNothing) {
  const Known f = ishigami(7.0, 0.1);
  const auto plain = answers(saltelli(256, 3), f.f);
  auto shifted = plain;
  for (auto& y : shifted) *y += 100.0;
  const SobolIndices one = sobol_indices({plain, plain, plain}, {3});
  const SobolIndices other = sobol_indices({plain, shifted, plain}, {3});
  const SobolIndices alone = sobol_indices({plain}, {3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(one.factors[i].first_order.value, other.factors[i].first_order.value, 1e-10);
    EXPECT_NEAR(one.factors[i].total.interval->high, other.factors[i].total.interval->high, 1e-10);
    EXPECT_NEAR(one.factors[i].total.value, alone.factors[i].total.value, 1e-10);
  }
}

// Of 60 studies with four seeds each, under which the slope of the first factor differs: how often
// intervals hold the indices of the mean over all seeds there could be.
TEST(SobolSeeds, IntervalsHoldTheScatterOfSeeds) {
  const Known known = linear({1.0, 1.0});
  const Eigen::MatrixXd cells = saltelli(128, 2);
  int held = 0, held_without = 0;
  for (std::uint64_t study = 0; study < 60; ++study) {
    const AnswersBySeed seeds = under_seeds(cells, known.f, 100 + 10 * study, 4, 0.4, 0.1);
    const Resampling resampling{.resamples = 300, .seed = study};
    held += covers(sobol_indices(seeds, {2}, resampling).factors[0].first_order, 0.5) ? 1 : 0;
    const AnswersBySeed two(seeds.begin(), seeds.begin() + 2);
    held_without += covers(sobol_indices(two, {2}, resampling).factors[0].first_order, 0.5) ? 1 : 0;
  }
  EXPECT_GE(held, 48) << "four seeds";
  EXPECT_LT(held_without, 48) << "two seeds cannot be resampled";
}

TEST(SobolSeeds, ABaseSampleCountsOnlyIfAllSeedsHaveIt) {
  const auto plain = answers(saltelli(16, 2), linear({1.0, 2.0}).f);
  auto gappy = plain;
  gappy[5] = std::nullopt;
  const SobolIndices indices = sobol_indices({plain, gappy, plain}, {2});
  EXPECT_EQ(indices.base_samples, 15);
  EXPECT_EQ(indices.left_out, 1);
  EXPECT_THROW(sobol_indices({plain, {plain.begin(), plain.end() - 4}}, {2}),
               std::invalid_argument);
}

TEST(SobolSeeds, OfNoiseAloneSayWhyThereAreNone) {
  // Opposite answers under two seeds: their mean is constant.
  const auto plain = answers(saltelli(16, 2), linear({1.0, 2.0}).f);
  auto opposite = plain;
  for (auto& y : opposite) y = -*y;
  EXPECT_EQ(sobol_indices({plain, opposite}, {2}).undefined,
            "the mean over seeds does not vary, for all that the seeds show");
}

}  // namespace
}  // namespace shoal::analysis
