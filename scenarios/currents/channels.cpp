#include <algorithm>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {
namespace {

/// Three channels along x: still water between two opposite streams (Rypkema 2015, sec. 4.2).
struct Channels final : Current {
  double speed_m_s = 0.1;
  double half_width_m = 150.0;

  void sample(double, std::span<const double>, std::span<const double> y_m, std::span<double> u_m_s,
              std::span<double> v_m_s) const override {
    for (std::size_t i = 0; i < y_m.size(); ++i) {
      // The banks themselves, y = +-half_width_m, belong to the still channel.
      u_m_s[i] = y_m[i] > half_width_m ? speed_m_s : y_m[i] < -half_width_m ? -speed_m_s : 0.0;
    }
    std::ranges::fill(v_m_s, 0.0);
  }

  static void declare(Options<Channels>& o) {
    o.number("speed_m_s", &Channels::speed_m_s, "m/s", in(-10.0, 10.0),
             "velocity towards east in the northern channel; the southern one runs opposite");
    o.number("half_width_m", &Channels::half_width_m, "m", at_least(0.0),
             "half the width of the still channel in the middle");
  }
};

const Register<Current, Channels> registered{
    "channels", "two opposite streams with still water between (Rypkema 2015, sec. 4.2)"};

}  // namespace
}  // namespace shoal::scenarios
