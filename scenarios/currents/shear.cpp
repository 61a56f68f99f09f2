#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {
namespace {

/// A current that changes linearly across its direction and with depth: a plane shear, which stands
/// for the side of a stream.
struct Shear final : Current {
  double u = 0.0, v = 0.0;
  double u_per_y = 1e-3, v_per_x = 0.0;
  double u_per_depth = 0.0, v_per_depth = 0.0;

  void sample(double, std::span<const double> x_m, std::span<const double> y_m,
              std::span<double> u_m_s, std::span<double> v_m_s) const override {
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      u_m_s[i] = u + u_per_y * y_m[i];
      v_m_s[i] = v + v_per_x * x_m[i];
    }
  }

  void sample_at(double time_s, std::span<const double> x_m, std::span<const double> y_m,
                 std::span<const double> depth_m, std::span<double> u_m_s,
                 std::span<double> v_m_s) const override {
    sample(time_s, x_m, y_m, u_m_s, v_m_s);
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      u_m_s[i] += u_per_depth * depth_m[i];
      v_m_s[i] += v_per_depth * depth_m[i];
    }
  }

  static void declare(Options<Shear>& o) {
    o.number("u_m_s", &Shear::u, "m/s", in(-10.0, 10.0), "velocity towards east at the origin");
    o.number("v_m_s", &Shear::v, "m/s", in(-10.0, 10.0), "velocity towards north at the origin");
    o.number("u_per_y", &Shear::u_per_y, "1/s", in(-1.0, 1.0),
             "how it grows per metre towards north");
    o.number("v_per_x", &Shear::v_per_x, "1/s", in(-1.0, 1.0),
             "how it grows per metre towards east");
    o.number("u_per_depth", &Shear::u_per_depth, "1/s", in(-1.0, 1.0),
             "how it grows per metre of depth");
    o.number("v_per_depth", &Shear::v_per_depth, "1/s", in(-1.0, 1.0),
             "how it grows per metre of depth");
  }
};

const Register<Current, Shear> registered{"shear", "a velocity that changes linearly with place"};

}  // namespace
}  // namespace shoal::scenarios
