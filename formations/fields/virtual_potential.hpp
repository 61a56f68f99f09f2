#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/formations/fields/contours.hpp"
#include "shoal/formations/fields/rotor.hpp"
#include "shoal/formations/obstacle.hpp"
#include "shoal/solvers/problem.hpp"

namespace shoal::formations {

/// Another vehicle, as the middle of a formation cell.
struct Agent {
  Eigen::Vector2d position;  ///< metres
  double heading_rad = 0.0;  ///< counter-clockwise from x
};

/// The square cell around every other agent: four vertices that attract, and a disc to keep off.
/// Barisic et al. 2011, sec. 3.
struct FormationCell {
  enum class Axes { fixed, heading };

  double side_m = 30.0;
  Axes axes = Axes::fixed;
  VertexContour vertex;
  ObstacleContour agent{.reach_m = 6.0};
  double agent_radius_m = 3.0;

  /// v_jk = x_j + f (cos, sin)(th_j + k pi/2); th_j is 0 or the heading of the agent.
  std::array<Eigen::Vector2d, 4> vertices(const Agent& middle) const;

  static void declare(Options<FormationCell>& o);
};

/// The gains of the virtual potential. The chapter prints none; the defaults are ours,
/// tried in the scenarios potentials_*.
struct VirtualPotentialGains {
  WaypointContour waypoint;
  ObstacleContour obstacle;
  Rotor rotor;
  FormationCell cell;
  double damping_per_s = 0.05 / 1.4;

  static void declare(Options<VirtualPotentialGains>& o);
};

/// The potential of one waypoint, of obstacles and of other agents, and the force that a vehicle
/// takes from it: Barisic et al. 2011, eq. 17-29.
///
/// All places in metres, in the frame of the own positions. Immutable, thread-safe, does not
/// allocate. Refers to the obstacles, which must outlive it.
class VirtualPotential {
 public:
  VirtualPotential(const VirtualPotentialGains& gains, const Eigen::Vector2d& waypoint,
                   Obstacles obstacles);

  /// The sum of all potentials, m2/s2.
  PlaneValue potential(const Eigen::Vector2d& place, std::span<const Agent> others) const;

  /// The rotors of all obstacles, m/s2; other agents, waypoint and vertices have none.
  Eigen::Vector2d rotor(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity) const;

  /// The total control force per unit of mass, m/s2: the potential's, eq. 21 with the signs and
  /// directions of C9 to C11, the rotors', and the damping -c_v v of C12, without which no lag
  /// makes a vehicle come to rest.
  Eigen::Vector2d force(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity,
                        std::span<const Agent> others) const;

  const VirtualPotentialGains& gains() const { return gains_; }

 private:
  VirtualPotentialGains gains_;
  Eigen::Vector2d waypoint_;
  Obstacles obstacles_;
};

/// The sum of all potentials as an objective of two unknowns, x and y (m), relative to an origin.
/// A value of its own, but for the obstacles, which must outlive it.
class VirtualPotentialCost final : public solvers::Objective {
 public:
  VirtualPotentialCost(const VirtualPotential& potential, const Eigen::Vector2d& origin,
                       std::span<const Agent> others)
      : potential_(potential), origin_(origin), others_(others.begin(), others.end()) {}

  double evaluate(const double* x, double* gradient, double* hessian) const override;
  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return solvers::copied_into(*this, storage, size);
  }

 private:
  VirtualPotential potential_;
  Eigen::Vector2d origin_;
  std::vector<Agent> others_;
};

}  // namespace shoal::formations
