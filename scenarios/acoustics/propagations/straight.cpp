#include "shoal/scenarios/acoustics/propagation.hpp"

namespace shoal::scenarios {
namespace {

/// A sphere that grows at one speed: Rypkema 2015, Table 3.2.
struct Straight final : Propagation {
  double sound_speed_m_s = 1500.0;

  double past_m(double since_s, const Eigen::Vector3d& sender,
                const Eigen::Vector3d& receiver) const override {
    return sound_speed_m_s * since_s - (receiver - sender).norm();
  }

  double longest_s(double range_m) const override { return range_m / sound_speed_m_s; }

  static void declare(Options<Straight>& o) {
    o.number("sound_speed_m_s", &Straight::sound_speed_m_s, "m/s", above(0), "speed of sound");
  }
};

const Register<Propagation, Straight> registered{
    "straight", "along straight rays, at one speed of sound (Rypkema 2015, Table 3.2)"};

}  // namespace
}  // namespace shoal::scenarios
