#pragma once

#include <span>

#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {

/// weight |p - c|^2 with the centroid c of all neighbours in range, against the fracture of a swarm
/// whose parts select among themselves: Rypkema 2015, eq. 3.7. The author's program divides the sum
/// of their positions by one more: it counts the own position, zero.
struct TowardsCentroid final : Cohesion {
  double weight;  // 1/m
  bool counts_own;

  explicit TowardsCentroid(double weight_per_m = 1e-5, bool own_counts = false)
      : weight(weight_per_m), counts_own(own_counts) {}

  Eigen::Vector2d anchor(std::span<const Neighbour> in_range,
                         const Eigen::Vector2d&) const override {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Neighbour& n : in_range) sum += n.position;
    return sum / static_cast<double>(in_range.size() + (counts_own ? 1 : 0));
  }
  PlaneValue at(const Eigen::Vector2d& from_anchor) const override {
    return squared_distance(weight, from_anchor);
  }

  static void declare(Options<TowardsCentroid>& o) {
    o.number("weight", &TowardsCentroid::weight, "1/m", at_least(0),
             "of the squared distance to it");
    o.flag("counts_own", &TowardsCentroid::counts_own,
           "whether the own position counts: not in eq. 3.7, but in the author's program");
  }
};

}  // namespace shoal::formations
