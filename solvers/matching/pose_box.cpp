#include "shoal/solvers/matching/pose_box.hpp"

namespace shoal::solvers {

std::pair<PoseBox, PoseBox> PoseBox::split(double radius) const {
  const int axis = half.x() >= half.y() ? 0 : 1;
  PoseBox turned = *this, shifted = *this;
  turned.arc *= 0.5;
  shifted.half[axis] *= 0.5;
  const double by_turning = radius * (spread() - turned.spread());
  const double by_shifting = reach() - shifted.reach();
  if (by_turning > by_shifting || (arc > 0.5 * std::numbers::pi && radius > reach())) {
    PoseBox other = turned;
    turned.middle.angle -= turned.arc;
    other.middle.angle += turned.arc;
    return {turned, other};
  }
  PoseBox other = shifted;
  shifted.middle.place[axis] -= shifted.half[axis];
  other.middle.place[axis] += shifted.half[axis];
  return {shifted, other};
}

}  // namespace shoal::solvers
