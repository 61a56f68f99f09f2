#include <algorithm>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {
namespace {

/// Acute-angle mesh: a spring to b if and only if for every other neighbour c the angle at c
/// between the vehicle and b is acute. Shucker and Bennett 2007 (the Gabriel graph of the
/// positions).
///
/// Only who is nearer than b can see the two under 90 degrees or more. On top of the vehicle there
/// is no angle at c, and c does not stand between them.
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

const Enrol<Selection, AcuteAngle> enrolled{
    "acute_angle", "springs that nobody sees under a right angle (Shucker and Bennett 2007)"};

}  // namespace
}  // namespace shoal::formations
