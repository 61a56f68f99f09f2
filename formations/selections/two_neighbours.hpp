#pragma once

#include <limits>
#include <span>
#include <vector>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// The nearest neighbour, and the one that makes the triangle with it and the vehicle shortest: Lee
/// and Chong 2008; Rypkema 2015, Alg. 5, lines 6-23.
struct TwoNeighbours final : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.clear();
    if (in_range.empty()) return;
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < in_range.size(); ++i) {
      if (in_range[i].position.norm() < in_range[nearest].position.norm()) nearest = i;
    }
    chosen.push_back(static_cast<int>(nearest));

    const Eigen::Vector2d first = in_range[nearest].position;
    std::size_t second = nearest;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < in_range.size(); ++i) {
      if (i == nearest) continue;
      const Eigen::Vector2d& p = in_range[i].position;
      const double sides = p.norm() + (p - first).norm();
      if (sides < shortest) {
        shortest = sides;
        second = i;
      }
    }
    if (second != nearest) chosen.push_back(static_cast<int>(second));
  }

  static void declare(Options<TwoNeighbours>&) {}
};

}  // namespace shoal::formations
