#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "shoal/analysis/statistics/design.hpp"

namespace shoal::analysis {
namespace {

using Numbers = std::vector<std::pair<std::string, std::int64_t>>;

Eigen::MatrixXd cells(const std::string& kind, const Numbers& options,
                      const std::vector<int>& levels) {
  Setting table;
  for (const auto& [name, value] : options) assign(table, name, {.value = value});
  return Registry<Design>::instance().make(kind, table, "design." + kind)->cells(levels);
}

std::vector<int> continuous(int factors) {
  return std::vector<int>(static_cast<std::size_t>(factors), 0);
}

std::string complaint_of(const std::string& kind, const Numbers& options,
                         const std::vector<int>& levels) {
  try {
    cells(kind, options, levels);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// How many cells each of n equal parts of a factor's range holds.
std::vector<int> counts(const Eigen::VectorXd& places, int n) {
  std::vector<int> counts(static_cast<std::size_t>(n), 0);
  for (const double u : places) ++counts.at(static_cast<std::size_t>(u * n));
  return counts;
}

TEST(Designs, OfTheSameSeedAreTheSameAndOfAnotherSeedOthers) {
  for (const char* kind : {"latin_hypercube", "sobol", "saltelli", "morris"}) {
    const Eigen::MatrixXd once = cells(kind, {{"seed", 0}}, continuous(3));
    EXPECT_EQ(once, cells(kind, {{"seed", 0}}, continuous(3))) << kind;
    EXPECT_NE(once, cells(kind, {{"seed", 1}}, continuous(3))) << kind;
    EXPECT_GE(once.minCoeff(), 0.0) << kind;
    EXPECT_LE(once.maxCoeff(), 1.0) << kind;
  }
}

TEST(Designs, ThatDrawNeedAFactor) {
  for (const char* kind : {"latin_hypercube", "sobol", "saltelli", "morris"}) {
    EXPECT_NE(complaint_of(kind, {}, {}), "") << kind;
  }
}

TEST(Designs, RefuseMoreCellsThanFitIntoMemory) {
  EXPECT_NE(complaint_of("saltelli", {{"base_samples", 1 << 22}}, continuous(3)), "");
  EXPECT_NE(complaint_of("morris", {{"trajectories", 5'000'000}}, continuous(3)), "");
}

TEST(LatinHypercube, HasOneCellInEachStratumOfEachFactor) {
  for (const int n : {1, 7, 100}) {
    const Eigen::MatrixXd drawn = cells("latin_hypercube", {{"samples", n}}, continuous(4));
    ASSERT_EQ(drawn.rows(), n);
    for (const auto& column : drawn.colwise()) {
      EXPECT_EQ(counts(column, n), std::vector<int>(static_cast<std::size_t>(n), 1));
    }
  }
}

TEST(LatinHypercube, PairsStrataAnewForEachFactor) {
  const Eigen::MatrixXd drawn = cells("latin_hypercube", {{"samples", 400}}, continuous(2));
  const Eigen::ArrayXd x = drawn.col(0).array() - 0.5, y = drawn.col(1).array() - 0.5;
  const double correlation = (x * y).mean() / std::sqrt(x.square().mean() * y.square().mean());
  EXPECT_LT(std::abs(correlation), 4.0 / std::sqrt(400.0));  // four standard errors
}

TEST(LatinHypercube, PutsCellsAnywhereWithinTheirStrata) {
  const Eigen::MatrixXd drawn = cells("latin_hypercube", {{"samples", 1000}}, continuous(1));
  Eigen::VectorXd within = 1000.0 * drawn.col(0);
  within = within.array() - within.array().floor();
  EXPECT_NEAR(within.mean(), 0.5, 4.0 / std::sqrt(12.0 * 1000.0));
  EXPECT_LT(within.minCoeff(), 0.05);
  EXPECT_GT(within.maxCoeff(), 0.95);
}

TEST(Sobol, HasOnePointInEachStratumOfEachFactorWhateverTheShift) {
  for (const int seed : {0, 1, 12345}) {
    const Eigen::MatrixXd drawn =
        cells("sobol", {{"samples", 128}, {"seed", seed}}, continuous(20));
    for (const auto& column : drawn.colwise()) {
      EXPECT_EQ(counts(column, 128), std::vector<int>(128, 1));
    }
  }
}

TEST(Sobol, FillsEveryBoxOfTheFirstTwoFactors) {
  // The first two dimensions are a (0, m, 2)-net, with or without a shift: of 2^m points every box
  // of size 2^-p by 2^-q, p + q = m, holds one (Niederreiter 1992, ch. 4).
  const Eigen::MatrixXd drawn = cells("sobol", {{"samples", 64}}, continuous(2));
  for (const int rows : {1, 2, 4, 8, 16, 32, 64}) {
    const int columns = 64 / rows;
    std::set<std::pair<int, int>> boxes;
    for (const auto& point : drawn.rowwise()) {
      boxes.emplace(static_cast<int>(point[0] * rows), static_cast<int>(point[1] * columns));
    }
    EXPECT_EQ(boxes.size(), 64U) << rows;
  }
}

TEST(Sobol, OfFewerSamplesIsTheBeginning) {
  EXPECT_EQ(cells("sobol", {{"samples", 16}}, continuous(3)),
            cells("sobol", {{"samples", 64}}, continuous(3)).topRows(16));
}

TEST(Sobol, GivesALevelToEqualNumbersOfCells) {
  const Eigen::MatrixXd drawn = cells("sobol", {{"samples", 32}}, {4, 0});
  EXPECT_EQ(counts(drawn.col(0), 4), std::vector<int>(4, 8));
}

TEST(Sobol, TakesPowersOfTwoAndNamesTheNearest) {
  const std::string wrong = complaint_of("sobol", {{"samples", 100}}, continuous(1));
  EXPECT_NE(wrong.find("give 64 or 128"), std::string::npos) << wrong;
  const std::string more = complaint_of("saltelli", {{"base_samples", 1000}}, continuous(1));
  EXPECT_NE(more.find("give 512 or 1024"), std::string::npos) << more;
  EXPECT_EQ(cells("sobol", {{"samples", 1}}, continuous(2)).rows(), 1);
}

TEST(Sobol, IsRefusedPastTheDimensionsThatAreKnown) {
  EXPECT_EQ(complaint_of("sobol", {{"samples", 1}}, continuous(3667)), "");
  EXPECT_NE(complaint_of("sobol", {{"samples", 1}}, continuous(3668)), "");
  EXPECT_NE(complaint_of("saltelli", {{"base_samples", 1}}, continuous(1834)), "");
}

TEST(Saltelli, HasRowsAThenAWithOneValueOfBEachThenB) {
  const Eigen::MatrixXd drawn = cells("saltelli", {{"base_samples", 8}}, continuous(3));
  const Eigen::MatrixXd points = cells("sobol", {{"samples", 8}}, continuous(6));
  ASSERT_EQ(drawn.rows(), 8 * 5);
  for (Eigen::Index j = 0; j < 8; ++j) {
    const Eigen::RowVectorXd a = points.row(j).head(3), b = points.row(j).tail(3);
    EXPECT_EQ(drawn.row(5 * j), a);
    EXPECT_EQ(drawn.row(5 * j + 1), Eigen::RowVector3d(b[0], a[1], a[2]));
    EXPECT_EQ(drawn.row(5 * j + 2), Eigen::RowVector3d(a[0], b[1], a[2]));
    EXPECT_EQ(drawn.row(5 * j + 3), Eigen::RowVector3d(a[0], a[1], b[2]));
    EXPECT_EQ(drawn.row(5 * j + 4), b);
  }
}

TEST(Saltelli, OfPairsHasRowsBWithOneValueOfABeforeB) {
  Setting table;
  assign(table, "base_samples", {.value = std::int64_t{8}});
  assign(table, "second_order", {.value = true});
  const Eigen::MatrixXd drawn =
      Registry<Design>::instance().make("saltelli", table, "design.saltelli")->cells(continuous(2));
  const Eigen::MatrixXd plain = cells("saltelli", {{"base_samples", 8}}, continuous(2));
  ASSERT_EQ(drawn.rows(), 8 * 6);
  for (Eigen::Index j = 0; j < 8; ++j) {
    const Eigen::RowVectorXd a = plain.row(4 * j), b = plain.row(4 * j + 3);
    EXPECT_EQ(drawn.middleRows(6 * j, 3), plain.middleRows(4 * j, 3));
    EXPECT_EQ(drawn.row(6 * j + 3), Eigen::RowVector2d(a[0], b[1]));
    EXPECT_EQ(drawn.row(6 * j + 4), Eigen::RowVector2d(b[0], a[1]));
    EXPECT_EQ(drawn.row(6 * j + 5), b);
  }
}

TEST(Saltelli, OfFewerBaseSamplesIsTheBeginning) {
  EXPECT_EQ(cells("saltelli", {{"base_samples", 4}}, continuous(2)),
            cells("saltelli", {{"base_samples", 32}}, continuous(2)).topRows(4 * 4));
}

TEST(Morris, ChangesEveryFactorOnceATrajectoryByDelta) {
  for (const int levels : {2, 4, 6}) {
    const double delta = levels / (2.0 * (levels - 1));
    const Eigen::MatrixXd drawn =
        cells("morris", {{"trajectories", 20}, {"levels", levels}}, continuous(5));
    ASSERT_EQ(drawn.rows(), 20 * 6);
    EXPECT_GE(drawn.minCoeff(), 0.0);
    EXPECT_LE(drawn.maxCoeff(), 1.0);
    for (Eigen::Index t = 0; t < 20; ++t) {
      Eigen::VectorXi changes = Eigen::VectorXi::Zero(5);
      for (Eigen::Index step = 0; step < 5; ++step) {
        const Eigen::RowVectorXd change = drawn.row(6 * t + step + 1) - drawn.row(6 * t + step);
        ASSERT_EQ((change.array() != 0.0).count(), 1);
        Eigen::Index f = 0;
        EXPECT_NEAR(change.cwiseAbs().maxCoeff(&f), delta, 1e-15);
        ++changes[f];
      }
      EXPECT_EQ(changes, Eigen::VectorXi::Ones(5));
    }
  }
}

TEST(Morris, StartsEverywhereAndGoesBothWaysInAnyOrder) {
  const Eigen::MatrixXd drawn = cells("morris", {{"trajectories", 400}}, continuous(2));
  int up = 0, first = 0;
  std::vector<int> starts(4, 0);
  for (Eigen::Index t = 0; t < 400; ++t) {
    const Eigen::RowVector2d start = drawn.row(3 * t), end = drawn.row(3 * t + 2);
    up += end[0] > start[0] ? 1 : 0;
    first += drawn(3 * t + 1, 0) != start[0] ? 1 : 0;
    ++starts.at(static_cast<std::size_t>(std::lround(3.0 * start[0])));
  }
  EXPECT_NEAR(up, 200, 4 * 10);  // four standard deviations of the binomial
  EXPECT_NEAR(first, 200, 4 * 10);
  for (const int count : starts) EXPECT_NEAR(count, 100, 4 * 8.7);
}

TEST(Morris, OfFewerTrajectoriesIsTheBeginning) {
  EXPECT_EQ(cells("morris", {{"trajectories", 3}}, continuous(4)),
            cells("morris", {{"trajectories", 9}}, continuous(4)).topRows(3 * 5));
}

TEST(Morris, ChangesAFactorByHalfItsLevels) {
  const auto level = [](double u, int n) { return std::min(static_cast<int>(u * n), n - 1); };
  for (const int n : {2, 4, 12}) {
    const Eigen::MatrixXd drawn = cells("morris", {{"trajectories", 50}, {"levels", 12}}, {n, 0});
    std::set<int> reached;
    for (Eigen::Index t = 0; t < 50; ++t) {
      const int from = level(drawn(3 * t, 0), n), to = level(drawn(3 * t + 2, 0), n);
      EXPECT_EQ(std::abs(to - from), n / 2);
      reached.insert({from, to});
    }
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(n));
  }
}

TEST(Morris, RefusesLevelsThatItCannotStepOverEvenly) {
  EXPECT_NE(complaint_of("morris", {{"levels", 4}}, {0, 3}), "");
  EXPECT_NE(complaint_of("morris", {{"levels", 4}}, {6, 0}), "");
  EXPECT_NE(complaint_of("morris", {{"levels", 4}}, {1}), "");
  const std::string odd = complaint_of("morris", {{"levels", 5}}, continuous(2));
  EXPECT_NE(odd.find("give 4 or 6"), std::string::npos) << odd;
}

}  // namespace
}  // namespace shoal::analysis
