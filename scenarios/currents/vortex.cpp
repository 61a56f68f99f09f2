#include <cmath>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {
namespace {

/// A counter-clockwise vortex about the origin, speed 1 / (r / scale + offset): Rypkema 2015,
/// eq. 4.5.
///
/// The thesis calls it irrotational. It is not: the speed of an irrotational vortex falls as 1/r,
/// this one is finite at the centre (0.5 m/s) and approaches 1/r only for r >> scale * offset.
struct Vortex final : Current {
  double scale_m = 200.0;  ///< m / (s/m): eq. 4.5 divides metres by it and adds the result to s/m
  double offset = 2.0;     ///< s/m

  void sample(double, std::span<const double> x_m, std::span<const double> y_m,
              std::span<double> u_m_s, std::span<double> v_m_s) const override {
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      const double r = std::sqrt(x_m[i] * x_m[i] + y_m[i] * y_m[i]);
      const double speed = 1.0 / (r / scale_m + offset);
      // At the centre the direction follows the convention atan2(0, 0) + 90 degrees: north.
      u_m_s[i] = r > 0.0 ? -speed * y_m[i] / r : 0.0;
      v_m_s[i] = r > 0.0 ? speed * x_m[i] / r : speed;
    }
  }

  static void declare(Options<Vortex>& o) {
    o.number("scale_m", &Vortex::scale_m, "m2/s", above(0.0),
             "metres over which the reciprocal of the speed grows by 1 s/m");
    o.number("offset", &Vortex::offset, "s/m", above(0.0), "reciprocal of the speed at the centre");
  }
};

const Register<Current, Vortex> registered{"vortex",
                                           "a counter-clockwise vortex (Rypkema 2015, eq. 4.5)"};

}  // namespace
}  // namespace shoal::scenarios
