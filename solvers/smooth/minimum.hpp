#pragma once

#include "shoal/solvers/problem.hpp"

namespace shoal::solvers {

/// Downward curvatures of less than this part of the largest one are taken for flat: near the ring
/// round a single neighbour the cost curves downwards along it by as much as the ring is missed.
inline constexpr double negligible_curvature = 1e-4;

/// Curvatures of less than this part of the largest one are rounding.
inline constexpr double curvature_of_rounding = 1e-10;

/// How far a point is outside the bounds, m.
double bounds_violation(const Problem& problem, const Eigen::Ref<const Eigen::VectorXd>& x);

/// How far the worst constraint is below zero, or the worst equality from it, in its own unit.
double constraint_violation(const Problem& problem, const Eigen::Ref<const Eigen::VectorXd>& x);

/// Our own check of an answer: whether nothing is to be gained near x but by leaving the bounds or
/// breaking a constraint.
///
/// With the multipliers that fit best (at least zero, for the bounds and constraints that hold x
/// back), Newton's step along the surface of these constraints must be about as short as
/// `x_tolerance_m`, and the cost must not curve downwards along it, so that no saddle passes for a
/// minimum. Where the cost has no curvature at all the gradient must be negligible beside
/// `largest_gradient`, the largest one met.
bool is_local_minimum(const Problem& problem, const Problem::Vector& x, double x_tolerance_m,
                      double largest_gradient);

}  // namespace shoal::solvers
