#pragma once

// The arithmetic of ukf.hpp.

#include <algorithm>
#include <cmath>

#include "shoal/scenarios/estimators/ukf.hpp"

namespace shoal::scenarios {

namespace detail {

template <int N>
void wrap(Eigen::Matrix<double, N, 1>& x, const std::array<bool, N>& is_angle) {
  for (int i = 0; i < N; ++i) {
    if (is_angle[static_cast<std::size_t>(i)]) x(i) = wrapped(x(i));
  }
}

/// Replaces the points by their differences from their weighted mean, which is returned.
///
/// The mean is taken of differences from the central point: the weights add up to one, so this is
/// the same number without the cancellation of large weights, and on the circle it is the angle
/// with the least squared distance from the points (the intrinsic mean).
template <int N, int Points>
Eigen::Matrix<double, N, 1> centre(Eigen::Matrix<double, N, Points>& points,
                                   const std::array<bool, N>& is_angle, double weight) {
  const Eigen::Matrix<double, N, 1> first = points.col(0);
  points.colwise() -= first;
  for (int i = 0; i < N; ++i) {
    if (!is_angle[static_cast<std::size_t>(i)]) continue;
    for (int k = 1; k < Points; ++k) points(i, k) = wrapped(points(i, k));
  }
  const Eigen::Matrix<double, N, 1> moved =
      weight * points.template rightCols<Points - 1>().rowwise().sum();
  points.colwise() -= moved;
  Eigen::Matrix<double, N, 1> mean = first + moved;
  wrap<N>(mean, is_angle);
  return mean;
}

/// sum of w_c d e^T over the differences d and e of all points from their means.
template <int N, int M, int Points>
Eigen::Matrix<double, N, M> spread(const Eigen::Matrix<double, N, Points>& d,
                                   const Eigen::Matrix<double, M, Points>& e,
                                   const SigmaWeights& weights) {
  Eigen::Matrix<double, N, M> sum;
  sum.noalias() = weights.other * (d.template rightCols<Points - 1>() *
                                   e.template rightCols<Points - 1>().transpose());
  sum.noalias() += (weights.covariance_centre * d.col(0)) * e.col(0).transpose();
  return sum;
}

/// sum of w_c d d^T.
template <int N, int Points>
Eigen::Matrix<double, N, N> spread(const Eigen::Matrix<double, N, Points>& d,
                                   const SigmaWeights& weights) {
  return spread<N, N, Points>(d, d, weights);
}

template <class Matrix>
void symmetrise(Matrix& P) {
  P = (0.5 * (P + P.transpose())).eval();
}

}  // namespace detail

template <int N, int M>
Ukf<N, M>::Ukf(const Settings& settings, const State& x, const StateCovariance& P)
    : settings_(settings), weights_(sigma_weights(N, settings.scaling)) {
  require_covariance<N>(settings_.process_covariance, "ukf: the process covariance R_v");
  require_covariance<M>(settings_.measurement_covariance, "ukf: the measurement covariance R_n");
  for (int i = 0; i < M; ++i) {
    if (settings_.measurement_memory(i) >= 0.0 && settings_.measurement_memory(i) < 1.0) continue;
    throw InputError("ukf: the memory of measurement noise takes correlations in [0, 1)");
  }
  if (!(settings_.gate.sigma >= 0.0) || settings_.gate.patience < 1) {
    throw InputError("ukf: the outlier gate takes sigma >= 0 and a patience of at least 1");
  }
  restart(x, P);
}

template <int N, int M>
void Ukf<N, M>::restart(const State& x, const StateCovariance& P) {
  if (!x.allFinite()) throw InputError("ukf: the initial estimate is not finite");
  require_covariance<N>(P, "ukf: the initial covariance P_x(0)");
  x_ = x;
  detail::wrap<N>(x_, settings_.state_is_angle);
  P_ = P;
  lower_root<N>(P_, S_);
  rejections_.fill(0);
  last_used_.reset();
  remembered_.reset();
}

template <int N, int M>
UkfStatus Ukf<N, M>::draw() {
  UkfStatus status = UkfStatus::ok;
  constexpr double farthest = 0.9 * std::numbers::pi;
  for (int i = 0; i < N; ++i) {
    if (!settings_.state_is_angle[static_cast<std::size_t>(i)]) continue;
    const double reach = weights_.gamma * S_.row(i).cwiseAbs().maxCoeff();
    if (reach <= farthest) continue;
    const double shrink = farthest / reach;
    S_.row(i) *= shrink;
    P_.row(i) *= shrink;
    P_.col(i) *= shrink;
    status = UkfStatus::saturated;
  }
  X_.col(0) = x_;
  X_.template middleCols<N>(1) = (weights_.gamma * S_).colwise() + x_;
  X_.template rightCols<N>() = (-weights_.gamma * S_).colwise() + x_;
  return status;
}

// Takes an estimate as it is, repaired, or not at all.
template <int N, int M>
UkfStatus Ukf<N, M>::keep(const State& x, StateCovariance& P) {
  UkfStatus status = UkfStatus::ok;
  detail::symmetrise(P);
  StateCovariance S;
  if (!lower_root<N>(P, S)) {
    status = UkfStatus::repaired;
    if (!lift_eigenvalues<N>(P) || !lower_root<N>(P, S)) return UkfStatus::lost;
  }
  if (!x.allFinite()) return UkfStatus::lost;
  x_ = x;
  P_ = P;
  S_ = S;
  return status;
}

// What the points measure before they are moved.
template <int N, int M>
void Ukf<N, M>::expect_last() {
  last_expected_ = detail::centre<M, points>(Y_, settings_.measurement_is_angle, weights_.other);
  last_covariance_ = detail::spread<M, points>(Y_, weights_);
}

// The prediction, from the points that were moved.
template <int N, int M>
UkfStatus Ukf<N, M>::gather(UkfStatus drawn) {
  const State x = detail::centre<N, points>(X_, settings_.state_is_angle, weights_.other);
  StateCovariance P = detail::spread<N, points>(X_, weights_);
  P += settings_.process_covariance;  // C48
  const UkfStatus kept = keep(x, P);
  if (remembered_.any()) state_with_last_ = detail::spread<N, M, points>(X_, Y_, weights_);
  return std::max(drawn, kept);
}

// Turns the innovation of y into that of y - Phi y(k-1), and the covariances with it.
template <int N, int M>
void Ukf<N, M>::subtract_memory(CrossCovariance& P_xy) {
  Measurement phi = Measurement::Zero();
  for (int i = 0; i < M; ++i) {
    if (remembered_[static_cast<std::size_t>(i)]) phi(i) = settings_.measurement_memory(i);
  }
  Measurement before = last_y_ - last_expected_;
  detail::wrap<M>(before, settings_.measurement_is_angle);
  update_.innovation -= (phi.array() == 0.0).select(0.0, phi.cwiseProduct(before));

  // cov(h(x), h(x(k-1))) = H cov(x, h(x(k-1))), with H the regression of h on the prior's points.
  CrossCovariance scaled = state_with_last_;
  for (int j = 0; j < N; ++j) {
    scaled.row(j) -= S_.row(j).head(j) * scaled.topRows(j);
    if (S_(j, j) > 0.0) {
      scaled.row(j) /= S_(j, j);
    } else {
      scaled.row(j).setZero();
    }
  }
  const MeasurementCovariance with_last =
      (weights_.other * weights_.gamma) *
      (Y_.template middleCols<N>(1) - Y_.template rightCols<N>()) * scaled;
  auto& P_y = update_.innovation_covariance;
  const MeasurementCovariance remembered = with_last * phi.asDiagonal();
  P_y -= remembered + remembered.transpose();
  P_y += phi.asDiagonal() * last_covariance_ * phi.asDiagonal();
  const auto& R = settings_.measurement_covariance;
  noise_ = R - phi.asDiagonal() * R * phi.asDiagonal();
  P_xy -= state_with_last_ * phi.asDiagonal();
}

template <int N, int M>
void Ukf<N, M>::gate(CrossCovariance& P_xy, StateCovariance& P) {
  const double sigma = settings_.gate.sigma;
  if (sigma == 0.0) return;
  auto& P_y = update_.innovation_covariance;
  const auto outside = [&](int i) {
    const double nu = update_.innovation(i);
    return nu * nu > sigma * sigma * P_y(i, i);
  };
  for (int i = 0; i < M; ++i) {
    const auto bit = static_cast<std::size_t>(i);
    if (update_.missing[bit] || !outside(i) || rejections_[bit] < settings_.gate.patience) continue;
    update_.readmitted.set(bit);
    // The prior is widened along what this value tells of, so that all three covariances stay those
    // of one joint distribution.
    const Measurement s = P_y.col(i) - noise_.col(i);
    if (!(s(i) > 0.0)) continue;
    const State p = P_xy.col(i);
    const double nu = update_.innovation(i);
    const double more = (nu * nu / (sigma * sigma) - P_y(i, i)) / (s(i) * s(i));
    P.noalias() += more * p * p.transpose();
    P_xy.noalias() += more * p * s.transpose();
    P_y.noalias() += more * s * s.transpose();
  }
  for (int i = 0; i < M; ++i) {
    const auto bit = static_cast<std::size_t>(i);
    if (update_.missing[bit]) continue;
    const bool rejected = !update_.readmitted[bit] && outside(i);
    update_.rejected.set(bit, rejected);
    rejections_[bit] = rejected ? rejections_[bit] + 1 : 0;
  }
}

// The estimate, from what the points measure.
template <int N, int M>
const typename Ukf<N, M>::Update& Ukf<N, M>::take(const Measurement& y, UkfStatus drawn) {
  update_.missing.reset();
  update_.rejected.reset();
  update_.readmitted.reset();
  update_.gain.setZero();
  update_.nis = 0.0;
  update_.used = 0;
  update_.status = drawn;

  const Measurement expected =
      detail::centre<M, points>(Y_, settings_.measurement_is_angle, weights_.other);
  // The points lie at +-gamma S about the prior, the central one upon it.
  CrossCovariance P_xy;
  P_xy.noalias() = (weights_.other * weights_.gamma) * S_ *
                   (Y_.template middleCols<N>(1) - Y_.template rightCols<N>()).transpose();
  update_.innovation_covariance = detail::spread<M, points>(Y_, weights_);
  update_.innovation = y - expected;
  detail::wrap<M>(update_.innovation, settings_.measurement_is_angle);
  noise_ = settings_.measurement_covariance;
  if (remembered_.any()) subtract_memory(P_xy);
  remembered_.reset();
  update_.innovation_covariance += noise_;  // C50
  detail::symmetrise(update_.innovation_covariance);
  last_used_.reset();
  if (!expected.allFinite() || !update_.innovation_covariance.allFinite()) {
    update_.status = UkfStatus::lost;
    return update_;
  }
  for (int i = 0; i < M; ++i) {
    if (std::isfinite(y(i))) continue;
    update_.missing.set(static_cast<std::size_t>(i));
    update_.innovation(i) = std::numeric_limits<double>::quiet_NaN();
  }

  StateCovariance P = P_;
  gate(P_xy, P);

  // A deleted row is one that varies with nothing: this is the same as cutting it out (C51), at a
  // size that is known when compiling.
  Eigen::Matrix<double, M, M> P_y = update_.innovation_covariance;
  Measurement nu = update_.innovation;
  const std::bitset<M> unused = update_.missing | update_.rejected;
  update_.used = M - static_cast<int>(unused.count());
  if (update_.used == 0) return update_;
  for (int i = 0; i < M; ++i) {
    if (!unused[static_cast<std::size_t>(i)]) continue;
    P_y.row(i).setZero();
    P_y.col(i).setZero();
    P_y(i, i) = 1.0;
    P_xy.col(i).setZero();
    nu(i) = 0.0;
  }

  Eigen::Matrix<double, M, M> L;
  if (!lower_root<M>(P_y, L) || !(L.diagonal().minCoeff() > 0.0)) {
    update_.used = 0;
    update_.status = std::max(update_.status, UkfStatus::singular);
    return update_;
  }
  const auto lower = L.template triangularView<Eigen::Lower>();
  // W = P_xy L^-T, so that K = W L^-1 and K P_y K^T = W W^T.
  Eigen::Matrix<double, M, N> W = P_xy.transpose();
  lower.solveInPlace(W);
  P.noalias() -= W.transpose() * W;
  lower.solveInPlace(nu);
  update_.nis = nu.squaredNorm();
  State x = x_ + W.transpose() * nu;
  L.transpose().template triangularView<Eigen::Upper>().solveInPlace(W);
  update_.gain = W.transpose();
  detail::wrap<N>(x, settings_.state_is_angle);
  update_.status = std::max(update_.status, keep(x, P));
  last_y_ = y;
  for (int i = 0; i < M; ++i) {
    const auto bit = static_cast<std::size_t>(i);
    last_used_.set(bit, !unused[bit] && settings_.measurement_memory(i) > 0.0);
  }
  return update_;
}

}  // namespace shoal::scenarios
