// A guidance law of your own: straight to the target, always.

#include <cmath>
#include <shoal/formations/guidance.hpp>

using namespace shoal;
using namespace shoal::formations;

struct MyPursuit final : Guidance {
  double speed_m_s = 0.6;

  Command command(const Target&, const Eigen::Vector2d& to_target, const OwnState&,
                  Memory*) const override {
    return {.thrust = true,
            .heading_rad = std::atan2(to_target.y(), to_target.x()),
            .speed_m_s = speed_m_s};
  }
  double period_s() const override { return 0.25; }
  double highest_speed_m_s() const override { return speed_m_s; }

  static void declare(Options<MyPursuit>& o) {
    o.number("speed_m_s", &MyPursuit::speed_m_s, "m/s", above(0), "always");
  }
};

const Register<Guidance, MyPursuit> registered{"my_pursuit", "straight to the target, always"};
