// A current of your own: a jet towards east along the line y = 0.

#include <cmath>
#include <shoal/scenarios/currents/current.hpp>

using namespace shoal;
using namespace shoal::scenarios;

struct MyJet final : Current {
  double speed_m_s = 0.3;
  double width_m = 200.0;

  void sample(double, std::span<const double>, std::span<const double> y, std::span<double> u_m_s,
              std::span<double> v_m_s) const override {
    for (std::size_t i = 0; i < y.size(); ++i) {
      u_m_s[i] = speed_m_s * std::exp(-(y[i] / width_m) * (y[i] / width_m));
      v_m_s[i] = 0.0;
    }
  }

  static void declare(Options<MyJet>& o) {
    o.number("speed_m_s", &MyJet::speed_m_s, "m/s", in(0, 5), "on the line");
    o.number("width_m", &MyJet::width_m, "m", above(0), "where it has fallen to 1/e");
  }
};

const Register<Current, MyJet> registered{"my_jet", "a jet towards east"};
