#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// The virtual spring mesh: a spring to b is created if for every other neighbour c the angle at c
/// between the vehicle and b is acute, and cut as soon as one is not. Shucker and Bennett 2007;
/// Rypkema 2015, sec. 2.3.1. (The Gabriel graph of the positions. It needs no memory.)
///
/// Only a neighbour nearer than b can see the two under 90 degrees or more. On top of the vehicle
/// there is no angle at c, and c does not stand between them.
struct AcuteAngle final : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.clear();
    for (std::size_t i = 0; i < in_range.size(); ++i) {
      const Eigen::Vector2d& b = in_range[i].position;
      const bool cut = std::ranges::any_of(in_range, [&b](const Neighbour& other) {
        const Eigen::Vector2d& c = other.position;
        return c.squaredNorm() < b.squaredNorm() && !c.isZero(0.0) && c.dot(b - c) >= 0.0;
      });
      if (!cut) chosen.push_back(static_cast<int>(i));
    }
  }

  static void declare(Options<AcuteAngle>&) {}
};

}  // namespace shoal::formations
