#include "shoal/solvers/matching/rigid_matching.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

#include "shoal/solvers/matching/points.hpp"
#include "tests/solvers/matching_support.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;
using tests::assignment_cost;
using tests::lattice;
using tests::moved;

constexpr RigidMatchingOptions patient_options{.tolerance_m = 0.01, .budget = 2'000'000};

Points hexagonal(int columns, int rows, double separation_m) {
  Points slots;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      slots.emplace_back(separation_m * (i + 0.5 * (j % 2)), separation_m * std::sqrt(0.75) * j);
    }
  }
  return slots;
}

Points scattered(Points points, double sd_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sd_m);
  for (Vector2d& p : points) p += Vector2d(noise(random), noise(random));
  return points;
}

Points in_a_box(std::size_t count, double side_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-0.5 * side_m, 0.5 * side_m);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(side(random), side(random));
  return points;
}

/// Some of the points, in any order.
Points some_of(Points points, std::size_t left, unsigned seed) {
  std::ranges::shuffle(points, std::mt19937(seed));
  points.resize(left);
  return points;
}

Transform2 any_far_motion() {
  const double angle = *rc::gen::inRange(-3141, 3142) * 1e-3;
  return Transform2::from_angle(
      angle, Vector2d(*rc::gen::inRange(-9000, 9000), *rc::gen::inRange(-9000, 9000)));
}

double mean_of(const RigidMatching& matching, const RigidMatch& match, const Points& points,
               const Points& slots) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto slot = static_cast<std::size_t>(matching.slot_of_point()[i]);
    sum += (match.T_slots_points * points[i] - slots[slot]).norm();
  }
  return sum / static_cast<double>(points.size());
}

/// The answer is what it says: an injective assignment of that mean, not below its bound.
void expect_sound(const RigidMatching& matching, const RigidMatch& match, const Points& points,
                  const Points& slots) {
  const auto taken = matching.slot_of_point();
  ASSERT_EQ(taken.size(), points.size());
  EXPECT_EQ(std::set<int>(taken.begin(), taken.end()).size(), points.size());
  EXPECT_NEAR(mean_of(matching, match, points, slots), match.mean_m, 1e-6);
  EXPECT_LE(match.lower_bound_m, match.mean_m);
  EXPECT_GE(match.lower_bound_m, 0.0);
  if (match.status == RigidMatchStatus::exact) {
    EXPECT_LE(match.mean_m - match.lower_bound_m, patient_options.tolerance_m + 1e-6);
  }
}

RigidMatch matched(const Points& points, const Points& slots) {
  RigidMatching matching(slots, patient_options);
  const RigidMatch match = matching.match(points);
  expect_sound(matching, match, points, slots);
  return match;
}

// By all assignments, and for each by angles all round and Weiszfeld's method for the translation;
// nothing is shared with the search.

double sum_at(const Points& points, const Points& targets, double angle, Vector2d* place) {
  const Transform2 turn = Transform2::from_angle(angle, Vector2d::Zero());
  Points gaps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    gaps.emplace_back(targets[i] - turn * points[i]);
  }
  const auto sum = [&](const Vector2d& t) {
    double s = 0.0;
    for (const Vector2d& gap : gaps) s += (gap - t).norm();
    return s;
  };
  Vector2d t =
      std::accumulate(gaps.begin(), gaps.end(), Vector2d(0, 0)) / static_cast<double>(gaps.size());
  for (int step = 0; step < 60; ++step) {
    Vector2d weighted = Vector2d::Zero();
    double weights = 0.0;
    for (const Vector2d& gap : gaps) {
      const double weight = 1.0 / ((gap - t).norm() + 1e-9);
      weighted += weight * gap;
      weights += weight;
    }
    t = weighted / weights;
  }
  double least = sum(t);
  for (const Vector2d& gap : gaps) {
    if (sum(gap) < least) t = gap;
    least = std::min(least, sum(gap));
  }
  if (place) *place = t;
  return least;
}

double least_of_pairs(const Points& points, const Points& targets, double give_up) {
  constexpr int angles = 48;
  const double step = 2.0 * std::numbers::pi / angles;
  double radius = 0.0;
  for (const Vector2d& p : points) radius += p.norm();
  std::vector<double> sums;
  for (int k = 0; k < angles; ++k) sums.push_back(sum_at(points, targets, k * step, nullptr));
  double least = *std::ranges::min_element(sums);
  if (least - radius * step > give_up) return infinity;  // no sum changes faster than that
  for (int k = 0; k < angles; ++k) {
    const auto at = [&](int j) { return sums[static_cast<std::size_t>((j + angles) % angles)]; };
    if (at(k) > at(k - 1) || at(k) > at(k + 1)) continue;
    double low = (k - 1) * step, high = (k + 1) * step;
    for (int cut = 0; cut < 40; ++cut) {
      const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
      const double fa = sum_at(points, targets, a, nullptr);
      const double fb = sum_at(points, targets, b, nullptr);
      least = std::min({least, fa, fb});
      (fa < fb ? high : low) = fa < fb ? b : a;
    }
  }
  return least;
}

double by_trying_all(const Points& points, const Points& slots) {
  const Points about_centroid = tests::centred(points);
  std::vector<int> order(slots.size());
  std::iota(order.begin(), order.end(), 0);
  double least = infinity;
  std::set<std::vector<int>> seen;
  do {
    const std::vector<int> chosen(order.begin(),
                                  order.begin() + static_cast<std::ptrdiff_t>(points.size()));
    if (!seen.insert(chosen).second) continue;
    Points targets;
    for (const int j : chosen) targets.push_back(slots[static_cast<std::size_t>(j)]);
    least = std::min(least, least_of_pairs(about_centroid, targets, least));
  } while (std::next_permutation(order.begin(), order.end()));
  return least / static_cast<double>(points.size());
}

TEST(RigidMatching, AgreesWithAllAssignmentsOfAFew) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const std::size_t slots_count = 3 + seed % 4, points_count = 2 + seed % 3;
    if (points_count > slots_count) continue;
    const Points slots = seed % 2 ? in_a_box(slots_count, 600.0, seed)
                                  : some_of(lattice(3, 2, 200.0), slots_count, seed);
    const Points points = seed % 3 ? in_a_box(points_count, 500.0, 100 + seed)
                                   : scattered(some_of(slots, points_count, seed), 30.0, seed);
    const RigidMatch match = matched(points, slots);
    const double least = by_trying_all(points, slots);
    EXPECT_LE(match.lower_bound_m, least + 1e-6) << seed;
    EXPECT_GE(match.mean_m, least - 1e-3) << seed;
    if (match.status != RigidMatchStatus::exact) continue;
    EXPECT_LE(match.mean_m, least + patient_options.tolerance_m) << seed;
  }
}

TEST(RigidMatching, AgreesWithAllAssignmentsOfFiveToEight) {
  const Points slots = in_a_box(8, 800.0, 5);
  const Points points = scattered(some_of(slots, 5, 2), 60.0, 9);
  const RigidMatch match = matched(points, slots);
  const double least = by_trying_all(points, slots);
  EXPECT_NEAR(match.mean_m, least, patient_options.tolerance_m);
  EXPECT_LE(match.lower_bound_m, least + 1e-6);
  EXPECT_GT(match.lower_bound_m, least - 1.0);
}

TEST(RigidMatching, IsNotWorseThanAFineGridOfMotions) {
  for (const double sd_m : {15.0, 60.0}) {
    const Points slots = lattice(4, 4, 300.0);
    const Points points = scattered(some_of(lattice(3, 3, 300.0), 8, 3), sd_m, 4);
    const RigidMatch match = matched(points, slots);
    const Points centred = tests::centred(points);
    double least = infinity;
    for (double x = 0.0; x <= 900.0; x += 50.0) {
      for (double y = -900.0; y <= 0.0; y += 50.0) {
        Points shifted = slots;
        for (Vector2d& slot : shifted) slot -= Vector2d(x, y);
        for (int turn = 0; turn < 30; ++turn) {
          least = std::min(least, assignment_cost(centred, shifted, turn * 0.05236));
        }
      }
    }
    EXPECT_LE(match.mean_m, least / 8.0 + 1e-9) << sd_m;
  }
}

TEST(RigidMatching, IsZeroForAnyPartOfThePlanHoweverItLies) {
  EXPECT_TRUE(rc::check("parts of a plan", [] {
    const Points slots =
        *rc::gen::element(lattice(7, 6, 300.0), hexagonal(6, 6, 300.0), in_a_box(12, 900.0, 1));
    const auto left = static_cast<std::size_t>(*rc::gen::inRange(1, 21));
    const unsigned seed = *rc::gen::arbitrary<unsigned>();
    const Points part = some_of(slots, std::min(left, slots.size()), seed);
    const RigidMatch match = matched(moved(part, any_far_motion()), slots);
    RC_ASSERT(match.mean_m < (slots.size() > 12 ? 1e-6 : patient_options.tolerance_m));
    RC_ASSERT(match.status == RigidMatchStatus::exact);
  }));
}

TEST(RigidMatching, DoesNotDependOnMotionOrNamesOrThePrior) {
  const Points slots = hexagonal(7, 7, 300.0);
  RigidMatching matching(slots, patient_options);
  EXPECT_TRUE(rc::check("invariance", [&] {
    const unsigned seed = *rc::gen::arbitrary<unsigned>();
    const Points points = scattered(hexagonal(4, 4, 300.0), 8.0, seed);
    const RigidMatch plain = matching.match(points);
    RC_ASSERT(plain.status == RigidMatchStatus::exact);
    const Transform2 T = any_far_motion();
    const Points other = moved(some_of(points, points.size(), seed), T);
    const RigidMatch cold = matching.match(other);
    const RigidMatch warm = matching.match(other, plain.T_slots_points * T.inverse());
    const RigidMatch misled = matching.match(other, any_far_motion());
    for (const RigidMatch& match : {cold, warm, misled}) {
      RC_ASSERT(match.status == RigidMatchStatus::exact);
      RC_ASSERT(std::abs(match.mean_m - plain.mean_m) <= patient_options.tolerance_m);
    }
  }));
}

TEST(RigidMatching, DoesNotReflect) {
  const Points slots = {{0, 0}, {100, 0}, {200, 0}, {300, 0}, {0, 150}, {100, 400}};
  Points mirrored = slots;
  for (Vector2d& p : mirrored) p.x() = -p.x();
  const RigidMatch match = matched(mirrored, slots);
  EXPECT_GT(match.mean_m, 20.0);
  EXPECT_NEAR(match.mean_m, by_trying_all(mirrored, slots), patient_options.tolerance_m);
}

TEST(RigidMatching, TakesSwarmsOfNoExtent) {
  const Points slots = lattice(4, 3, 100.0);
  for (const Points& points : {Points{{1e6, -1e6}}, Points{{0, 0}, {100, 0}},
                               Points{{5, 5}, {105 * 1.0, 105}}, Points{{0, 0}, {100, 0}, {200, 0}},
                               moved(slots, Transform2::from_angle(1.0, {1e7, 1e7}))}) {
    const RigidMatch match = matched(points, slots);
    EXPECT_EQ(match.status, RigidMatchStatus::exact) << points.size();
  }
  EXPECT_NEAR(matched({{0, 0}, {150, 0}}, slots).mean_m, 0.5 * (150.0 - 100.0 * std::sqrt(2.0)),
              patient_options.tolerance_m);
  // In one place: their sum of distances to two slots 100 m apart is 100 m.
  EXPECT_NEAR(matched({{7, 7}, {7, 7}}, slots).mean_m, 50.0, patient_options.tolerance_m);
  // To three of a square: the geometric median of a right-angled isosceles triangle.
  EXPECT_NEAR(matched({{7, 7}, {7, 7}, {7, 7}}, slots).mean_m,
              100.0 * (1.0 + std::sqrt(3.0)) / std::sqrt(2.0) / 3.0, patient_options.tolerance_m);
  EXPECT_NEAR(matched({{9, 9}}, {{3, 4}}).mean_m, 0.0, 1e-9);
}

TEST(RigidMatching, SaysHowFarItMayBeWhereTheBudgetEndsFirst) {
  const Points slots = lattice(23, 24, 300.0);
  const Points points = scattered(some_of(lattice(22, 23, 300.0), 500, 1), 10.0, 2);
  RigidMatching matching(slots, {.tolerance_m = 0.01, .budget = 200'000});
  const RigidMatch match = matching.match(points, Transform2{});
  expect_sound(matching, match, points, slots);
  EXPECT_LT(match.mean_m, 15.0);
  EXPECT_EQ(match.status, RigidMatchStatus::budget);

  const Points box = in_a_box(500, 2000.0, 3);
  const RigidMatch crowded = matching.match(box);
  expect_sound(matching, crowded, box, slots);
  EXPECT_GT(crowded.mean_m, 500.0);
}

TEST(RigidMatching, GivesTheSameBitsAgain) {
  const Points slots = lattice(7, 6, 300.0);
  for (const double side_m : {200.0, 1500.0}) {
    const Points points = in_a_box(20, side_m, 7);
    RigidMatching one(slots), other(slots);
    other.match(in_a_box(9, 900.0, 8));
    const RigidMatch a = one.match(points), b = other.match(points);
    EXPECT_EQ(a.mean_m, b.mean_m);
    EXPECT_EQ(a.work, b.work);
  }
}

TEST(RigidMatching, RefusesWhatHasNoAnswer) {
  const Points slots = lattice(2, 2, 100.0);
  RigidMatching matching(slots);
  EXPECT_THROW(matching.match({}), std::invalid_argument);
  EXPECT_THROW(matching.match(lattice(3, 2, 100.0)), std::invalid_argument);
  EXPECT_THROW(matching.match(Points{{0, infinity}}), std::invalid_argument);
  EXPECT_THROW(RigidMatching({}), std::invalid_argument);
  EXPECT_THROW(RigidMatching(slots, {.tolerance_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::solvers
