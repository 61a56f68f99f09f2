#include "shoal/scenarios/currents/current_statistics.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

namespace shoal::scenarios {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;

constexpr double shear_distance_m = 300.0;
// Of the square of the velocities: below this they all are the same.
constexpr double same_velocity = 1e-12;

Index whole(double length, double step, const char* what) {
  const double steps = std::round(length / step);
  if (!(step > 0.0) || steps < 1.0 || std::abs(steps * step - length) > 1e-9 * length) {
    throw std::invalid_argument(std::string("a drifting window's ") + what +
                                " is no multiple of its step");
  }
  return static_cast<Index>(steps);
}

/// A column for each look; a row for each point, x fastest.
struct Velocities {
  Eigen::ArrayXXd u, v;
};

struct Observed {
  Velocities velocities;
  Index columns, rows;  ///< of the points
  Vector2d drift_m;
};

Observed observed(const Current& current, const DriftingWindow& window) {
  const Index columns = whole(window.width_m, window.spacing_m, "width") + 1;
  const Index rows = whole(window.height_m, window.spacing_m, "height") + 1;
  const Index looks = whole(window.duration_s, window.step_s, "duration") + 1;
  const Index points = columns * rows;
  ArrayXd x0(points), y0(points);
  for (Index i = 0; i < points; ++i) {
    const Index column = i % columns, row = i / columns;
    x0[i] = window.spacing_m * static_cast<double>(column) - 0.5 * window.width_m;
    y0[i] = window.spacing_m * static_cast<double>(row) - 0.5 * window.height_m;
  }
  const auto size = static_cast<std::size_t>(points);
  Observed seen{
      {Eigen::ArrayXXd(points, looks), Eigen::ArrayXXd(points, looks)}, columns, rows, {}};
  Vector2d centre = window.centre_m;
  for (Index k = 0; k < looks; ++k) {
    const ArrayXd x = x0 + centre.x(), y = y0 + centre.y();
    auto u = seen.velocities.u.col(k), v = seen.velocities.v.col(k);
    current.sample(static_cast<double>(k) * window.step_s, {x.data(), size}, {y.data(), size},
                   {u.data(), size}, {v.data(), size});
    if (k + 1 < looks) centre += window.step_s * Vector2d(u.mean(), v.mean());
  }
  seen.drift_m = centre - window.centre_m;
  return seen;
}

/// The mean of a function of two velocities over all pairs of points that are `steps` apart along x
/// or y.
template <class Function>
double mean_over_pairs(const Observed& seen, Index steps, const Function& of_pair) {
  double sum = 0.0, pairs = 0.0;
  const auto [columns, rows] = std::pair(seen.columns, seen.rows);
  const auto& [u, v] = seen.velocities;
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * columns + i;
      for (const auto& [inside, b] : {std::pair(i + steps < columns, a + steps),
                                      std::pair(j + steps < rows, a + steps * columns)}) {
        if (!inside) continue;
        sum += of_pair(u.row(a), u.row(b)) + of_pair(v.row(a), v.row(b));
        pairs += static_cast<double>(u.cols());
      }
    }
  }
  return sum / pairs;
}

/// Where correlations at the lags 0, step, 2 step ... first fall to 1/e.
template <class Correlation>
std::optional<double> falls_to_1_e(Index lags, double step, const Correlation& correlation) {
  constexpr double level = 1.0 / std::numbers::e;
  double before = 1.0;
  for (Index lag = 1; lag < lags; ++lag) {
    const double here = correlation(lag);
    if (here <= level) {
      return step * (static_cast<double>(lag - 1) + (before - level) / (before - here));
    }
    before = here;
  }
  return std::nullopt;
}

}  // namespace

std::vector<CurrentStatistic> current_statistics(const Current& current,
                                                 const DriftingWindow& window) {
  Observed seen = observed(current, window);
  Eigen::ArrayXXd& u = seen.velocities.u;
  Eigen::ArrayXXd& v = seen.velocities.v;
  const Index apart = whole(shear_distance_m, window.spacing_m, "shear distance");
  const double shear = std::sqrt(mean_over_pairs(
      seen, apart, [](const auto& a, const auto& b) { return (a - b).square().sum(); }));

  const Vector2d mean(u.mean(), v.mean());
  u -= mean.x();
  v -= mean.y();
  const Vector2d variance(u.square().mean(), v.square().mean());
  std::optional<double> length_m, time_s;
  if (variance.sum() > same_velocity * mean.squaredNorm()) {
    length_m = falls_to_1_e(std::max(seen.columns, seen.rows), window.spacing_m, [&](Index lag) {
      const auto product = [](const auto& a, const auto& b) { return (a * b).sum(); };
      return mean_over_pairs(seen, lag, product) / variance.sum();
    });
    time_s = falls_to_1_e(u.cols(), window.step_s, [&](Index lag) {
      const Index n = u.cols() - lag;
      return ((u.leftCols(n) * u.rightCols(n)).mean() + (v.leftCols(n) * v.rightCols(n)).mean()) /
             variance.sum();
    });
  }
  return {{"mean_u_m_s", "mean velocity to the east", mean.x()},
          {"mean_v_m_s", "mean velocity to the north", mean.y()},
          {"drift_m", "from where the window began to where it ended", seen.drift_m.norm()},
          {"variance_u_m2_s2", "variance of the velocity to the east", variance.x()},
          {"variance_v_m2_s2", "variance of the velocity to the north", variance.y()},
          {"shear_300m_m_s", "rms difference of velocities 300 m apart", shear},
          {"decorrelation_length_m", "distance at which the correlation is 1/e", length_m},
          {"decorrelation_time_s", "lag at which the correlation is 1/e", time_s}};
}

}  // namespace shoal::scenarios
