// A pair potential of your own, and the mark that makes this library a plugin.

#include <shoal/core/plugin.hpp>
#include <shoal/formations/potential.hpp>

SHOAL_PLUGIN

using namespace shoal;
using namespace shoal::formations;

/// A spring: stiffness / 2 (r - s)^2, in metres.
struct MySpring final : Potential {
  double stiffness_per_m = 0.01;

  double value(double r, double s) const override {
    return 0.5 * stiffness_per_m * (r - s) * (r - s);
  }
  RadialValue derivatives(double r, double s) const override {
    return {value(r, s), stiffness_per_m * (r - s), stiffness_per_m};
  }

  static void declare(Options<MySpring>& o) {
    o.number("stiffness_per_m", &MySpring::stiffness_per_m, "1/m", above(0), "of the spring");
  }
};

const Register<Potential, MySpring> registered{"my_spring", "a spring of your own"};
