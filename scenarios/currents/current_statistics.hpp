#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {

/// A rectangular grid of points that the mean of the current over it carries along, unturned: the
/// water that a formation of that size meets while it drifts.
///
/// As it stands: the extent of 5 rows of 4 vehicles at 300 m, for five hours (Rypkema 2015, sec.
/// 4.4.3).
struct DriftingWindow {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();  ///< at second 0
  double width_m = 900.0, height_m = 1200.0;           ///< along x and y
  double spacing_m = 100.0;                            ///< of the points
  double duration_s = 18000.0;
  double step_s = 100.0;  ///< between two looks; the window moves by Euler's steps of that length
};

/// One number about a current; no value where it is not defined.
struct CurrentStatistic {
  std::string name;  ///< ends with its unit
  std::string meaning;
  std::optional<double> value;
};

/// Statistics of the current over the points and instants of a window:
///
///  - `mean_u_m_s`, `mean_v_m_s`, and the length of the way from where the window began to where it
///    ended, `drift_m`;
///  - `variance_u_m2_s2`, `variance_v_m2_s2` about these means;
///  - `shear_300m_m_s`: the root mean square of |v(a) - v(b)| over points a and b that are 300 m
///    apart along x or y;
///  - `decorrelation_length_m`, `decorrelation_time_s`: the shortest distance (along x or y) and
///    lag (at a point of the window) at which the autocorrelation of the velocity about its mean
///    has fallen to 1/e, linear between the points and looks. No value where it does not fall that
///    far within the window, or where nothing varies.
///
/// Throws InputError where there is no current, and std::invalid_argument unless 300 m and the
/// window are multiples of the spacing, and the duration is one of the step.
std::vector<CurrentStatistic> current_statistics(const Current& current,
                                                 const DriftingWindow& window);

}  // namespace shoal::scenarios
