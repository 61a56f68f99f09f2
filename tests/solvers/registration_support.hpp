#pragma once

// Sets of pairs for the tests of registration: by hand, or drawn by rapidcheck.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "shoal/solvers/registration/registration.hpp"
#include "tests/support/nan_value.hpp"

namespace shoal::solvers::tests {

using Eigen::Vector2d;
using Pairs = std::vector<PointPair>;
using shoal::tests::nan_value;
inline constexpr double pi = std::numbers::pi;

inline std::unique_ptr<Loss> loss(const std::string& name, double scale_m = 0.0) {
  Setting table;
  if (scale_m > 0.0) table.at_or_new("scale_m").value = scale_m;
  return Registry<Loss>::instance().make(name, table, "loss." + name);
}

inline std::unique_ptr<RegistrationSolver> solver(const std::string& name,
                                                  double x_tolerance_m = 0.0,
                                                  std::int64_t max_evaluations = 0) {
  Setting table;
  if (x_tolerance_m > 0.0) table.at_or_new("x_tolerance_m").value = x_tolerance_m;
  if (max_evaluations > 0) table.at_or_new("max_evaluations").value = max_evaluations;
  return Registry<RegistrationSolver>::instance().make(name, table, "registration." + name);
}

inline std::vector<std::string> descents() {
  auto names = Registry<RegistrationSolver>::instance().names();
  std::erase(names, "procrustes");
  return names;
}

inline double cost_of(const Transform2& motion, const Pairs& pairs, const Loss& of) {
  double cost = 0.0;
  for (const PointPair& p : pairs) {
    cost += p.weight * of.at((motion * p.from - p.to).squaredNorm()).value;
  }
  return cost;
}

/// How far apart two motions carry the `from` points, at most, m.
inline double apart(const Transform2& a, const Transform2& b, const Pairs& pairs) {
  double most = 0.0;
  for (const PointPair& p : pairs) most = std::max(most, (a * p.from - b * p.from).norm());
  return most;
}

inline ::testing::AssertionResult is(const RegistrationSolution& solution, Status expected) {
  if (solution.status == expected) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << name_of(solution.status) << " after " << solution.evaluations;
}

// Draws, inside rc::check() only.

inline double drawn(double low, double high) {
  return low + (high - low) * (*rc::gen::resize(100, rc::gen::inRange(0, 1'000'001))) * 1e-6;
}

inline Vector2d drawn_point(double reach_m) {
  return {drawn(-reach_m, reach_m), drawn(-reach_m, reach_m)};
}

inline Transform2 drawn_motion(double reach_m = 1000.0) {
  return Transform2::from_angle(drawn(-pi, pi), drawn_point(reach_m));
}

inline int drawn_count(int least, int most) {
  return *rc::gen::resize(100, rc::gen::inRange(least, most + 1));
}

inline Pairs drawn_pairs() {
  Pairs pairs(static_cast<std::size_t>(drawn_count(3, 20)));
  for (PointPair& p : pairs) p = {drawn_point(1000), drawn_point(1000), drawn(0.1, 3.0)};
  return pairs;
}

/// A rigid motion of points in a formation, with noise of metres, and some pairs far off.
inline Pairs drawn_formation(int count, int outliers) {
  const Transform2 motion = drawn_motion();
  Pairs pairs(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].from = drawn_point(600);
    for (std::size_t k = 0; k < i; ++k) RC_PRE((pairs[i].from - pairs[k].from).norm() > 100.0);
    const bool outlier = i < static_cast<std::size_t>(outliers);
    pairs[i].to =
        motion * pairs[i].from + (outlier ? Vector2d(Transform2::from_angle(drawn(-pi, pi), {0, 0})
                                                         .rotate({drawn(300.0, 600.0), 0.0}))
                                          : drawn_point(5.0));
    pairs[i].weight = drawn(0.5, 1.5);
  }
  return pairs;
}

/// A lattice turned by 0.7 rad, with fixed noise of metres and, if wanted, a pair 500 m off.
inline Pairs lattice(double outlier_m = 0.0, const Vector2d& away = {40, -70}) {
  const auto motion = Transform2::from_angle(0.7, away);
  Pairs pairs;
  for (int i = 0; i < 10; ++i) {
    const Vector2d slot(300.0 * (i % 4), 300.0 * (i / 4));
    const Vector2d noise(3.0 * std::sin(7.0 * i), 3.0 * std::cos(11.0 * i));
    pairs.push_back({slot, motion * slot + noise, i == 0 ? 0.1 : 1.0});
  }
  pairs[6].to += Vector2d(0.0, outlier_m);
  return pairs;
}

}  // namespace shoal::solvers::tests
