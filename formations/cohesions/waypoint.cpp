#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {
namespace {

/// weight |p - w|^2 with a way-point w that is the same place for all vehicles. Pinciroli et al.
/// 2008 gather their swarm by such a global potential.
struct Waypoint final : Cohesion {
  double x_m = 0.0;
  double y_m = 0.0;
  double weight = 1e-5;

  Eigen::Vector2d anchor(std::span<const Neighbour>,
                         const Eigen::Vector2d& own_position) const override {
    return Eigen::Vector2d(x_m, y_m) - own_position;
  }
  PlaneValue at(const Eigen::Vector2d& from_anchor) const override {
    return squared_distance(weight, from_anchor);
  }

  static void declare(Options<Waypoint>& o) {
    o.number("x_m", &Waypoint::x_m, "m", {}, "east, in the frame of the own positions");
    o.number("y_m", &Waypoint::y_m, "m", {}, "north, in the frame of the own positions");
    o.number("weight", &Waypoint::weight, "1/m", at_least(0), "of the squared distance to it");
  }
};

const Enrol<Cohesion, Waypoint> enrolled{
    "waypoint", "pull towards a fixed place (as the global potential of Pinciroli et al. 2008)"};

}  // namespace
}  // namespace shoal::formations
