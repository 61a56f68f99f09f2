// Vehicles in moving water, each type by itself.

#include <gtest/gtest.h>

#include "shoal/scenarios/vehicles/swarm.hpp"

namespace shoal::scenarios {
namespace {

/// Where a vehicle is that heads north-east for 100 s in a uniform current.
struct Voyage {
  double x_m, y_m, depth_m, heading_rad, speed_m_s, energy_j;

  Voyage(const std::string& kind, double u_m_s, double v_m_s) {
    constexpr double tick_s = 0.25;
    const auto type = Registry<VehicleType>::instance().make(kind, {}, "vehicle." + kind);
    const auto swarm = type->launch({Start{5.0, -3.0, 0.3}}, Energy{}, RandomStreams(1), tick_s);
    const formations::Command command{.thrust = true, .heading_rad = 0.8, .speed_m_s = 0.8};
    for (std::int64_t tick = 0; tick < 400; ++tick) {
      swarm->advance(0, 1, tick, {&command, 1}, {&u_m_s, 1}, {&v_m_s, 1});
    }
    x_m = swarm->x_m[0];
    y_m = swarm->y_m[0];
    depth_m = swarm->depth_m[0];
    heading_rad = swarm->heading_rad[0];
    speed_m_s = swarm->speed_m_s[0];
    energy_j = swarm->propulsion_j[0];
  }
};

TEST(VehiclesInACurrent, AUniformOneIsAGalileanShift) {
  for (const std::string& kind : Registry<VehicleType>::instance().names()) {
    const Voyage still(kind, 0.0, 0.0), carried(kind, 0.25, -0.5);
    EXPECT_NEAR(carried.x_m - still.x_m, 25.0, 1e-9) << kind;
    EXPECT_NEAR(carried.y_m - still.y_m, -50.0, 1e-9) << kind;
    EXPECT_NEAR(carried.depth_m, still.depth_m, 1e-9) << kind;
    EXPECT_NEAR(carried.heading_rad, still.heading_rad, 1e-9) << kind;
    EXPECT_NEAR(carried.speed_m_s, still.speed_m_s, 1e-9) << kind;
    EXPECT_NEAR(carried.energy_j, still.energy_j, 1e-6) << kind;
    EXPECT_GT(still.x_m, 20.0) << kind;  // under way
  }
}

}  // namespace
}  // namespace shoal::scenarios
