#include "shoal/formations/fields/rotor.hpp"

#include <algorithm>

namespace shoal::formations {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

int sign(double x) {
  return x < 0.0 ? -1 : 1;  // a tie turns counter-clockwise
}

}  // namespace

// m points from the waypoint to the obstacle (C13: printed the other way, the rotor would vanish
// on the side where it is needed). Only the sign of the cross product counts (C14): its size goes
// to zero where the dead-lock is.
Rotor::Turn Rotor::turn(const Eigen::Vector2d& normal, const Eigen::Vector2d& obstacle_centre,
                        const Eigen::Vector2d& waypoint, const Eigen::Vector2d& velocity) const {
  const Eigen::Vector2d from_waypoint = obstacle_centre - waypoint;
  const double distance = from_waypoint.norm();
  if (!(distance > 0.0)) return {};
  const Eigen::Vector2d m = from_waypoint / distance;
  const double alignment = m.dot(normal);
  if (alignment > 1.0 - tie) return {alignment, sign(cross(normal, velocity))};
  if (alignment >= 0.0) return {alignment, sign(cross(m, normal))};
  return {alignment, 0};
}

Eigen::Vector2d Rotor::force(const Proximity& near, const Turn& turn) const {
  if (turn.sense == 0) return Eigen::Vector2d::Zero();
  // Untapered, the field jumps where the obstacle is passed.
  const double share = taper > 0.0 ? std::min(1.0, turn.alignment / taper) : 1.0;
  const Eigen::Vector2d around(-near.normal.y(), near.normal.x());
  return share * contour.push(near.distance) * turn.sense * around;
}

void Rotor::declare(Options<Rotor>& o) {
  o.table("contour", &Rotor::contour, "size of the force by the distance");
  o.number("tie", &Rotor::tie, "", in(0, 1),
           "so near to exactly behind an obstacle a vehicle turns as it already moves");
  o.number("taper", &Rotor::taper, "", in(0, 1),
           "the force fades where r_i of eq. 28 is below it; 0: it ends at once");
}

}  // namespace shoal::formations
