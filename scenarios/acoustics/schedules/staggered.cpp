#include "shoal/scenarios/acoustics/ping_schedule.hpp"

namespace shoal::scenarios {
namespace {

struct Staggered final : PingSchedule {
  double delay_s(std::size_t vehicle, std::size_t vehicles, double period_s) const override {
    return period_s * static_cast<double>(vehicle) / static_cast<double>(vehicles);
  }

  static void declare(Options<Staggered>&) {}
};

const Register<PingSchedule, Staggered> registered{
    "staggered", "one vehicle after the other, evenly spread over the period"};

}  // namespace
}  // namespace shoal::scenarios
