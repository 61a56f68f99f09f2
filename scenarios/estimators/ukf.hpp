#pragma once

#include <Eigen/Core>
#include <array>
#include <bitset>
#include <limits>

#include "shoal/core/angles.hpp"
#include "shoal/scenarios/estimators/covariance.hpp"
#include "shoal/scenarios/estimators/sigma_points.hpp"

namespace shoal::scenarios {

/// How a step of a filter went; where several things happened, the last of this list counts.
enum class UkfStatus {
  ok,
  saturated,  ///< an angle was so uncertain that sigma points met round the circle: its standard
              ///< deviation was cut back until they just do not
  repaired,   ///< a covariance was not positive semidefinite; its eigenvalues were lifted
  singular,   ///< the innovation covariance has no inverse: the measurement was not used
  lost,       ///< something was not finite: the estimate is the one before the step; restart()
};

/// A measured value further than `sigma` standard deviations of the innovation from its prediction
/// is an outlier (C52). After `patience` of them in a row the filter doubts itself instead: the
/// next one is let in, with the covariance widened until it lies just at the gate.
struct OutlierGate {
  double sigma = 4.0;  ///< 0: no gate
  int patience = 10;
};

/// The models of a filter of N states and M measurements. Angles (radians) are marked: their
/// differences are wrapped, their means are taken on the circle.
template <int N, int M>
struct UkfSettings {
  UkfScaling scaling;
  Eigen::Matrix<double, N, N> process_covariance;      ///< R_v, added in every prediction
  Eigen::Matrix<double, M, M> measurement_covariance;  ///< R_n
  /// Correlation of each measurement's noise with its own noise a step before; 0: white. R_n is
  /// then the covariance of a single sample.
  Eigen::Matrix<double, M, 1> measurement_memory = Eigen::Matrix<double, M, 1>::Zero();
  std::array<bool, N> state_is_angle{};
  std::array<bool, M> measurement_is_angle{};
  OutlierGate gate;
};

/// What became of a measurement.
template <int M, int N>
struct UkfUpdate {
  UkfStatus status = UkfStatus::ok;
  Eigen::Matrix<double, M, 1> innovation;  ///< NaN where nothing was measured
  Eigen::Matrix<double, M, M> innovation_covariance;
  Eigen::Matrix<double, N, M> gain;  ///< columns of values that were not used are zero
  std::bitset<M> missing;
  std::bitset<M> rejected;    ///< outliers that were not used
  std::bitset<M> readmitted;  ///< outliers that were used after too many in a row
  double nis = 0.0;           ///< normalised innovation squared, over the values used
  int used = 0;               ///< how many that were: the degrees of freedom of nis
};

/// Scaled unscented Kalman filter with additive noise: Barisic et al. 2011, Table 2, corrected by
/// C47-C52. Allocates nothing.
///
/// Measurement noise with a memory, n(k+1) = Phi n(k) + w, is made white by differences (Bryson and
/// Henrikson 1968): given the state before, y(k+1) - Phi y(k) = h(x(k+1)) - Phi h(x(k)) + w. A
/// value whose predecessor was not used starts afresh, with R_n: what the noise has in common with
/// that before the gap is not known then, and the filter is a little too sure of itself.
template <int N, int M>
class Ukf {
 public:
  using State = Eigen::Matrix<double, N, 1>;
  using StateCovariance = Eigen::Matrix<double, N, N>;
  using Measurement = Eigen::Matrix<double, M, 1>;
  using Settings = UkfSettings<N, M>;
  using Update = UkfUpdate<M, N>;

  /// Throws InputError if a covariance is none, or the scaling has no real sigma points.
  Ukf(const Settings& settings, const State& x, const StateCovariance& P);

  /// Starts again from an estimate. Throws InputError if P is no covariance, x not finite.
  void restart(const State& x, const StateCovariance& P);

  /// Time update; `process` is any callable State -> State.
  template <class Process>
  UkfStatus predict(const Process& process) {
    remembered_.reset();
    const UkfStatus drawn = draw();
    move_points(process);
    return gather(drawn);
  }

  /// The same where measurement noise has a memory; `measure` is that of the last correct().
  template <class Process, class Measure>
  UkfStatus predict(const Process& process, const Measure& measure) {
    const UkfStatus drawn = draw();
    remembered_ = last_used_;
    if (remembered_.any()) {
      measure_points(measure);
      expect_last();
    }
    move_points(process);
    return gather(drawn);
  }

  /// Measurement update; `measure` is any callable State -> Measurement. Values of y that are not
  /// finite are missing: their rows are deleted (C51), and without any the prediction stands.
  template <class Measure>
  const Update& correct(const Measurement& y, const Measure& measure) {
    const UkfStatus drawn = draw();  // redrawn from P^- (C49)
    measure_points(measure);
    return take(y, drawn);
  }

  const State& state() const { return x_; }
  const StateCovariance& covariance() const { return P_; }
  /// The lower triangular root of the covariance.
  const StateCovariance& root() const { return S_; }
  const Settings& settings() const { return settings_; }

 private:
  static constexpr int points = 2 * N + 1;
  using StatePoints = Eigen::Matrix<double, N, points>;
  using MeasurementPoints = Eigen::Matrix<double, M, points>;

  using CrossCovariance = Eigen::Matrix<double, N, M>;
  using MeasurementCovariance = Eigen::Matrix<double, M, M>;

  // What a model computes, point by point; the arithmetic around it is compiled once for all
  // models.
  template <class Process>
  void move_points(const Process& process) {
    for (int k = 0; k < points; ++k) X_.col(k) = State(process(State(X_.col(k))));
  }
  template <class Measure>
  void measure_points(const Measure& measure) {
    for (int k = 0; k < points; ++k) Y_.col(k) = Measurement(measure(State(X_.col(k))));
  }

  UkfStatus draw();
  UkfStatus keep(const State& x, StateCovariance& P);
  void expect_last();
  UkfStatus gather(UkfStatus drawn);
  const Update& take(const Measurement& y, UkfStatus drawn);
  void subtract_memory(CrossCovariance& P_xy);
  void gate(CrossCovariance& P_xy, StateCovariance& P);

  Settings settings_;
  SigmaWeights weights_;
  State x_;
  StateCovariance P_, S_;
  StatePoints X_;
  MeasurementPoints Y_;
  Update update_;
  std::array<int, M> rejections_{};  // in a row

  // Of the step before, where noise has a memory: what was measured and which of it was used, and
  // what the state after it had led to expect, with its covariances.
  Measurement last_y_, last_expected_;
  std::bitset<M> last_used_, remembered_;
  CrossCovariance state_with_last_;
  MeasurementCovariance last_covariance_, noise_;
};

}  // namespace shoal::scenarios

#include "shoal/scenarios/estimators/ukf_impl.hpp"
