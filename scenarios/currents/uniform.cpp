#include <algorithm>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {
namespace {

struct Uniform final : Current {
  double u = 0.0;
  double v = 0.0;

  void sample(double, std::span<const double>, std::span<const double>, std::span<double> u_m_s,
              std::span<double> v_m_s) const override {
    std::ranges::fill(u_m_s, u);
    std::ranges::fill(v_m_s, v);
  }

  static void declare(Options<Uniform>& o) {
    o.number("u_m_s", &Uniform::u, "m/s", in(-10.0, 10.0), "velocity towards east");
    o.number("v_m_s", &Uniform::v, "m/s", in(-10.0, 10.0), "velocity towards north");
  }
};

const Register<Current, Uniform> registered{"uniform", "the same velocity everywhere and always"};

}  // namespace
}  // namespace shoal::scenarios
