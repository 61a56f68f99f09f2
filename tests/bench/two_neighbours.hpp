#pragma once

#include <Eigen/Core>
#include <cmath>

namespace shoal::bench {

/// Rypkema 2015, eq. 3.4-3.7 with the neighbours of fig. 3.7.
struct TwoNeighbours {
  template <class T>
  T operator()(const T* p) const {
    using std::sqrt;
    const double s = 300.0;
    T cost(0.0);
    for (const Eigen::Vector2d& n : {Eigen::Vector2d(-280, -81), Eigen::Vector2d(-25, -193)}) {
      const T dx = p[0] - n.x(), dy = p[1] - n.y();
      const T squared = dx * dx + dy * dy;
      cost = cost + 0.5 * s * s * s / squared + sqrt(squared) - 3.0 * s;
    }
    const T dx = p[0] + 152.5, dy = p[1] + 137.0;
    return cost + 1e-5 * (dx * dx + dy * dy);
  }
};

}  // namespace shoal::bench
