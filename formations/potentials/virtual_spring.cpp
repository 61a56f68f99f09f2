#include "shoal/formations/potential.hpp"

namespace shoal::formations {
namespace {

/// A virtual spring of natural length s: f'(r) = k (r - s), f(r) = k (r - s)^2 / 2, in metres.
///
/// Fujibayashi et al. 2002. Their springs are also created and cut, by the number of connections:
/// here that is the work of the neighbour selection.
struct VirtualSpring {
  double stiffness_per_m = 0.01;  // at s = 300 m that of the thesis' potential

  template <class T>
  T operator()(const T& r, double s) const {
    const T stretch = r - s;
    return 0.5 * stiffness_per_m * stretch * stretch;
  }

  static void declare(Options<VirtualSpring>& o) {
    o.number("stiffness_per_m", &VirtualSpring::stiffness_per_m, "1/m", above(0),
             "k: force per metre of stretch");
  }
};

const EnrolPotential<VirtualSpring> enrolled{"virtual_spring",
                                             "a linear spring (Fujibayashi et al. 2002)"};

}  // namespace
}  // namespace shoal::formations
