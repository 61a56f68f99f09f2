#pragma once

#include <span>

#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {

struct NoCohesion final : Cohesion {
  Eigen::Vector2d anchor(std::span<const Neighbour>, const Eigen::Vector2d&) const override {
    return Eigen::Vector2d::Zero();
  }
  PlaneValue at(const Eigen::Vector2d&) const override { return {}; }

  static void declare(Options<NoCohesion>&) {}
};

}  // namespace shoal::formations
