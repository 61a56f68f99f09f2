#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// The k nearest neighbours; of two at the same distance the one that comes first.
struct KNearest final : Selection {
  std::int64_t k;

  explicit KNearest(std::int64_t count = 6) : k(count) {}

  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.resize(in_range.size());
    std::iota(chosen.begin(), chosen.end(), 0);
    const auto count = std::min(k, static_cast<std::int64_t>(chosen.size()));
    const auto key = [&](int i) {
      return std::pair(in_range[static_cast<std::size_t>(i)].position.squaredNorm(), i);
    };
    std::ranges::partial_sort(chosen, chosen.begin() + count, {}, key);
    chosen.resize(static_cast<std::size_t>(count));
  }

  static void declare(Options<KNearest>& o) {
    o.integer("k", &KNearest::k, "", at_least(1), "how many; 6 in a lattice of triangles");
  }
};

}  // namespace shoal::formations
