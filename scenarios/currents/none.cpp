#include <algorithm>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::scenarios {
namespace {

struct Still final : Current {
  void sample(double, std::span<const double>, std::span<const double>, std::span<double> u_m_s,
              std::span<double> v_m_s) const override {
    std::ranges::fill(u_m_s, 0.0);
    std::ranges::fill(v_m_s, 0.0);
  }

  static void declare(Options<Still>&) {}
};

const Register<Current, Still> registered{"none", "still water (thesis scenario 1)"};

}  // namespace
}  // namespace shoal::scenarios
