#include "shoal/analysis/experiments/measures/tracks.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <numbers>
#include <random>

namespace shoal::analysis {
namespace {

using std::numbers::pi;

std::vector<std::span<const Eigen::Vector2d>> spans(const std::vector<Track>& tracks) {
  return {tracks.begin(), tracks.end()};
}

TEST(Tracks, HaveTheLengthOfTheirSteps) {
  EXPECT_EQ(length_m(Track{{0, 0}, {30, 40}, {30, 0}}), 90.0);
  EXPECT_EQ(length_m(Track{{5, 5}}), 0.0);
}

TEST(Tracks, ApproachTheirEndUntilTheyAreNearIt) {
  const Track track = {{0, 0}, {50, 0}, {75, 0}, {110, 0}, {100, 0}};
  EXPECT_EQ(approach(track, 30.0).size(), 3u);
  EXPECT_EQ(approach(track, 1000.0).size(), 1u);
  EXPECT_EQ(approach(track, 0.0).size(), 5u);
}

TEST(Tracks, ThatGoStraightToTheirEndNeverGetFarther) {
  EXPECT_EQ(away_m(Track{{0, 0}, {10, 0}, {40, 0}, {100, 0}}), 0.0);
  EXPECT_EQ(away_m(Track{{0, 0}}), 0.0);
}

TEST(Tracks, ThatArcAwayGetFartherByWhatTheyGo) {
  EXPECT_EQ(away_m(Track{{0, 0}, {-30, 0}, {0, 40}, {100, 0}}), 30.0);
  // Half a circle of 50 m to a place 100 m away first goes across, and never farther.
  Track arc;
  for (int k = 0; k <= 18; ++k) {
    arc.emplace_back(50.0 - 50.0 * std::cos(pi * k / 18), 50.0 * std::sin(pi * k / 18));
  }
  EXPECT_NEAR(away_m(arc), 0.0, 1e-9);
}

TEST(Tracks, CrossWhereTheirStepsDo) {
  EXPECT_EQ(crossing_pairs(spans({{{0, 0}, {10, 10}}, {{0, 10}, {10, 0}}})), 1);
  EXPECT_EQ(crossing_pairs(spans({{{0, 0}, {10, 0}}, {{0, 1}, {10, 1}}})), 0);
  // Two that meet in their ends only touch.
  EXPECT_EQ(crossing_pairs(spans({{{0, 0}, {10, 10}}, {{10, 10}, {20, 0}}})), 0);
  EXPECT_EQ(crossing_pairs({}), 0);
}

TEST(Tracks, ThatCrossTwiceAreOnePairAndThoseThatCrossThemselvesNone) {
  const Track zigzag = {{0, -5}, {5, 5}, {10, -5}, {15, 5}};
  const Track line = {{-5, 0}, {20, 0}};
  EXPECT_EQ(crossing_pairs(spans({zigzag, line})), 1);
  EXPECT_EQ(crossing_pairs(spans({{{0, 0}, {10, 0}, {10, 10}, {5, -10}}})), 0);
}

TEST(Tracks, ThatFanOutFromABoxToAGridInOrderDoNotCross) {
  std::vector<Track> ordered, exchanged;
  for (int i = 0; i < 5; ++i) {
    ordered.push_back({{i * 10.0, 0.0}, {i * 300.0, 500.0}});
    exchanged.push_back({{i * 10.0, 0.0}, {(4 - i) * 300.0, 500.0}});
  }
  EXPECT_EQ(crossing_pairs(spans(ordered)), 0);
  EXPECT_EQ(crossing_pairs(spans(exchanged)), 10);  // every pair
}

TEST(Tracks, CrossAsThePlainLoopOverAllStepsSays) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0.0, 10.0);
  std::vector<Track> tracks(12);
  for (Track& track : tracks) {
    track.emplace_back(2 * normal(generator), 2 * normal(generator));
    for (int k = 0; k < 15; ++k) {
      track.push_back(track.back() + Eigen::Vector2d(normal(generator), normal(generator)));
    }
  }
  const auto left_of = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& p) {
    Eigen::Matrix2d m;
    m << b - a, p - a;
    return m.determinant() > 0.0;
  };
  int pairs = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      bool cross = false;
      for (std::size_t p = 1; p < tracks[i].size(); ++p) {
        for (std::size_t q = 1; q < tracks[j].size(); ++q) {
          const auto &a = tracks[i][p - 1], &b = tracks[i][p];
          const auto &c = tracks[j][q - 1], &d = tracks[j][q];
          cross |= left_of(a, b, c) != left_of(a, b, d) && left_of(c, d, a) != left_of(c, d, b);
        }
      }
      pairs += cross ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 10);
  EXPECT_LT(pairs, 60);
  EXPECT_EQ(crossing_pairs(spans(tracks)), pairs);
}

TEST(Tracks, TurnFromStepToStep) {
  EXPECT_EQ(turn({0, 0}, {10, 0}, {20, 0}), 0.0);
  EXPECT_NEAR(turn({0, 0}, {10, 0}, {10, 10}), pi / 2, 1e-12);
  EXPECT_NEAR(turn({0, 0}, {10, 0}, {10, -10}), pi / 2, 1e-12);
  EXPECT_NEAR(turn({0, 0}, {10, 0}, {0, 0}), pi, 1e-12);
}

}  // namespace
}  // namespace shoal::analysis
