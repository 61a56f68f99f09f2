#pragma once

#include <numeric>
#include <span>
#include <vector>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// All of them: Rypkema 2015, eq. 3.5. Minima then lie nearer than the separation in the midst of a
/// swarm and farther at its edge, which is why the thesis chooses two.
struct InRange final : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.resize(in_range.size());
    std::iota(chosen.begin(), chosen.end(), 0);
  }

  static void declare(Options<InRange>&) {}
};

}  // namespace shoal::formations
