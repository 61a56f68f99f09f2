#include "shoal/formations/fields/virtual_potential.hpp"

#include <cmath>

#include "shoal/formations/obstacles/shapes.hpp"

namespace shoal::formations {
namespace {

PlaneValue kept_off(const Obstacle& obstacle, const ObstacleContour& contour,
                    const Eigen::Vector2d& place) {
  const Proximity near = obstacle.nearest(place);
  return of_distance(contour.at(near.distance), near.normal, near.curvature);
}

}  // namespace

std::array<Eigen::Vector2d, 4> FormationCell::vertices(const Agent& middle) const {
  const bool turned = axes == Axes::heading;
  const Eigen::Vector2d ahead = turned ? Eigen::Vector2d(side_m * std::cos(middle.heading_rad),
                                                         side_m * std::sin(middle.heading_rad))
                                       : Eigen::Vector2d(side_m, 0.0);
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const Eigen::Vector2d& x = middle.position;
  return {x + ahead, x + left, x - ahead, x - left};
}

VirtualPotential::VirtualPotential(const VirtualPotentialGains& gains,
                                   const Eigen::Vector2d& waypoint, Obstacles obstacles)
    : gains_(gains), waypoint_(waypoint), obstacles_(obstacles) {}

PlaneValue VirtualPotential::potential(const Eigen::Vector2d& place,
                                       std::span<const Agent> others) const {
  const Eigen::Vector2d to_waypoint = place - waypoint_;
  PlaneValue sum = of_displacement(gains_.waypoint.at(to_waypoint.norm()), to_waypoint);
  for (const auto& obstacle : obstacles_) sum += kept_off(*obstacle, gains_.obstacle, place);

  // An occupied vertex is masked by what its occupant repels; there is no further rule.
  const FormationCell& cell = gains_.cell;
  for (const Agent& other : others) {
    sum += kept_off(Circle(other.position, cell.agent_radius_m), cell.agent, place);
    for (const Eigen::Vector2d& vertex : cell.vertices(other)) {
      const Eigen::Vector2d away = place - vertex;
      sum += of_displacement(cell.vertex.at(away.norm()), away);
    }
  }
  return sum;
}

Eigen::Vector2d VirtualPotential::rotor(const Eigen::Vector2d& place,
                                        const Eigen::Vector2d& velocity) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& obstacle : obstacles_) {
    const Proximity near = obstacle->nearest(place);
    const Rotor::Turn turn =
        gains_.rotor.turn(near.normal, obstacle->centre(), waypoint_, velocity);
    sum += gains_.rotor.force(near, turn);
  }
  return sum;
}

Eigen::Vector2d VirtualPotential::force(const Eigen::Vector2d& place,
                                        const Eigen::Vector2d& velocity,
                                        std::span<const Agent> others) const {
  return -potential(place, others).gradient + rotor(place, velocity) -
         gains_.damping_per_s * velocity;
}

double VirtualPotentialCost::evaluate(const double* x, double* gradient, double* hessian) const {
  const PlaneValue at = potential_.potential(origin_ + Eigen::Vector2d(x[0], x[1]), others_);
  if (gradient) Eigen::Map<Eigen::Vector2d>(gradient, 2) = at.gradient;
  if (hessian) Eigen::Map<Eigen::Matrix2d>(hessian, 2, 2) = at.hessian;
  return at.value;
}

void FormationCell::declare(Options<FormationCell>& o) {
  using C = FormationCell;
  o.number("side_m", &C::side_m, "m", above(0), "f: distance of neighbours in the square lattice");
  o.word("axes", &C::axes, {{"fixed", Axes::fixed}, {"heading", Axes::heading}},
         "of the cells: along x and y, or turning with the agent in the middle");
  o.table("vertex", &C::vertex, "attraction of the four vertices");
  o.table("agent", &C::agent, "repulsion of the agent in the middle");
  o.number("agent_radius_m", &C::agent_radius_m, "m", above(0), "of the disc around it");
}

void VirtualPotentialGains::declare(Options<VirtualPotentialGains>& o) {
  using G = VirtualPotentialGains;
  o.table("waypoint", &G::waypoint, "attraction of the waypoint");
  o.table("obstacle", &G::obstacle, "repulsion of obstacles");
  o.table("rotor", &G::rotor, "force that leads round obstacles");
  o.table("cell", &G::cell, "formation cell around every other agent");
  o.number("damping_per_s", &G::damping_per_s, "1/s", at_least(0),
           "c_v: force against the velocity; pull / c_v is the speed of the cruise");
}

}  // namespace shoal::formations
