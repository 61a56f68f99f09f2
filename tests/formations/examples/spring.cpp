#include "shoal/formations/potential.hpp"

namespace shoal::formations {
namespace {

/// A spring between two vehicles: (r - s)^2 / 2, in square metres.
struct Spring {
  double stiffness = 1.0;

  template <class T>
  T operator()(const T& r, double s) const {  // r, s in metres
    return 0.5 * stiffness * (r - s) * (r - s);
  }

  static void declare(Options<Spring>& o) {
    o.number("stiffness", &Spring::stiffness, "", above(0), "pull per metre of stretch");
  }
};

const RegisterPotential<Spring> registered{"spring", "a spring"};

}  // namespace
}  // namespace shoal::formations
