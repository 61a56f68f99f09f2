#pragma once

#include "shoal/solvers/loss.hpp"

namespace shoal::solvers {

struct SquaredResidual final : Loss {
  LossValue at(double squared) const override { return {squared, 1.0, 0.0}; }
  bool is_square() const override { return true; }

  static void declare(Options<SquaredResidual>&) {}
};

}  // namespace shoal::solvers
