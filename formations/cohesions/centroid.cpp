#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {
namespace {

/// weight |p - c|^2 with the centroid c of all neighbours in range, against the fracture of a swarm
/// whose parts select among themselves: Rypkema 2015, eq. 3.7. The author's program divides the sum
/// of their positions by one more: it counts the own position, zero.
struct Centroid final : Cohesion {
  double weight = 1e-5;
  bool counts_own = false;

  Eigen::Vector2d anchor(std::span<const Neighbour> in_range,
                         const Eigen::Vector2d&) const override {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Neighbour& n : in_range) sum += n.position;
    return sum / static_cast<double>(in_range.size() + (counts_own ? 1 : 0));
  }
  PlaneValue at(const Eigen::Vector2d& from_anchor) const override {
    return squared_distance(weight, from_anchor);
  }

  static void declare(Options<Centroid>& o) {
    o.number("weight", &Centroid::weight, "1/m", at_least(0), "of the squared distance to it");
    o.flag("counts_own", &Centroid::counts_own,
           "whether the own position counts: not in eq. 3.7, but in the author's program");
  }
};

const Register<Cohesion, Centroid> registered{
    "centroid", "pull towards the centroid of all neighbours in range (Rypkema 2015, eq. 3.7)"};

}  // namespace
}  // namespace shoal::formations
