#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>

#include "shoal/core/error.hpp"

namespace shoal::scenarios {

/// The lower triangular S of P = S S^T; columns of directions without variance are zero.
///
/// Returns false where P is not positive semidefinite beyond rounding, or not finite. Only the
/// lower half of P is read.
template <int N>
bool lower_root(const Eigen::Matrix<double, N, N>& P, Eigen::Matrix<double, N, N>& S) {
  constexpr double rounding = 8.0 * N * std::numeric_limits<double>::epsilon();
  S.setZero();
  for (int j = 0; j < N; ++j) {
    const double variance = P(j, j);
    const double pivot = variance - S.row(j).head(j).squaredNorm();
    if (!std::isfinite(pivot) || !(pivot >= -rounding * variance)) return false;
    const int below = N - 1 - j;
    auto column = S.col(j).tail(below);
    column = P.col(j).tail(below);
    column.noalias() -= S.bottomLeftCorner(below, j) * S.row(j).head(j).transpose();
    if (pivot > rounding * variance) {
      S(j, j) = std::sqrt(pivot);
      column /= S(j, j);
      continue;
    }
    // Nothing is left in this direction; then nothing can vary with it either (Cauchy-Schwarz).
    for (int i = j + 1; i < N; ++i) {
      if (!(S(i, j) * S(i, j) <= 4.0 * rounding * variance * P(i, i))) return false;
    }
    column.setZero();
  }
  return true;
}

/// A covariance of any size that a filter here has: its solvers are compiled once, and allocate
/// nothing.
using AnyCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;

/// Lifts the eigenvalues of P, as a correlation matrix, to at least 1e-9: the nearest thing to P
/// that a filter can go on with. Returns false where P is not finite.
bool lift_eigenvalues(AnyCovariance& P);

/// The same matrix. Eigen does not check its size in a release build: the compiler does, here.
template <int N>
AnyCovariance any_covariance(const Eigen::Matrix<double, N, N>& P) {
  static_assert(N <= AnyCovariance::MaxRowsAtCompileTime);
  return P;
}

template <int N>
bool lift_eigenvalues(Eigen::Matrix<double, N, N>& P) {
  AnyCovariance lifted = any_covariance<N>(P);
  if (!lift_eigenvalues(lifted)) return false;
  P = lifted;
  return true;
}

/// Throws InputError: how P is no covariance, whose entries are finite and symmetric.
[[noreturn]] void refuse_indefinite(const AnyCovariance& P, const std::string& name);

/// Throws InputError if P is no covariance: not finite, not symmetric, not positive semidefinite.
template <int N>
void require_covariance(const Eigen::Matrix<double, N, N>& P, const std::string& name) {
  if (!P.allFinite()) throw InputError(name + " is not finite; every entry has to be a number");
  const double largest = P.cwiseAbs().maxCoeff();
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(P(i, j) - P(j, i)) <= 1e-12 * largest) continue;
      throw InputError(name + " is not symmetric: entry (" + std::to_string(i) + ", " +
                       std::to_string(j) + ") is " + std::to_string(P(i, j)) +
                       ", its mirror image " + std::to_string(P(j, i)));
    }
  }
  Eigen::Matrix<double, N, N> root;
  if (!lower_root<N>(P, root)) refuse_indefinite(any_covariance<N>(P), name);
}

}  // namespace shoal::scenarios
