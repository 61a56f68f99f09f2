#include <algorithm>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {
namespace {

/// The nearest neighbour only.
struct Nearest : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.clear();
    const auto distance = [](const Neighbour& n) { return n.position.norm(); };
    const auto nearest = std::ranges::min_element(in_range, {}, distance);
    if (nearest != in_range.end()) chosen.push_back(static_cast<int>(nearest - in_range.begin()));
  }

  static void declare(Options<Nearest>&) {}
};

const Register<Selection, Nearest> registered{"nearest", "the nearest neighbour only"};

}  // namespace
}  // namespace shoal::formations
