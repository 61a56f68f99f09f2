#include "shoal/scenarios/acoustics/ping_schedule.hpp"

namespace shoal::scenarios {
namespace {

struct Synchronous final : PingSchedule {
  double delay_s(std::size_t, std::size_t, double) const override { return 0.0; }

  static void declare(Options<Synchronous>&) {}
};

const Register<PingSchedule, Synchronous> registered{
    "synchronous", "all vehicles ping at once, as in the author's trials"};

}  // namespace
}  // namespace shoal::scenarios
