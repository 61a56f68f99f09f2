#include "shoal/scenarios/currents/netcdf_waters.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "shoal/core/error.hpp"
#include "tests/support/netcdf_writer.hpp"

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;

class WatersOf : public testing::Test {
 protected:
  const fs::path file_ =
      fs::path(testing::TempDir()) / ("shoal_waters_" + std::to_string(getpid()) + ".nc");
  const WatersRequest request_{.file = file_, .origin = {}, .u_variable = "", .v_variable = ""};

  void SetUp() override { write(0.25); }
  void TearDown() override { fs::remove(file_); }

  /// The same current everywhere, eastwards.
  void write(double u_m_s) const {
    tests::NetcdfWriter w(file_);
    w.dimension("y", 2).variable("y", NC_DOUBLE, {"y"}, {0, 100});
    w.text("standard_name", "projection_y_coordinate").text("units", "m");
    w.dimension("x", 2).variable("x", NC_DOUBLE, {"x"}, {0, 100});
    w.text("standard_name", "projection_x_coordinate").text("units", "m");
    for (const char* name : {"u", "v"}) {
      const double velocity = *name == 'u' ? u_m_s : 0.0;
      w.variable(name, NC_DOUBLE, {"y", "x"}, std::vector<double>(4, velocity))
          .text("units", "m/s");
      w.text("standard_name",
             *name == 'u' ? "eastward_sea_water_velocity" : "northward_sea_water_velocity");
    }
    w.finish();
  }
};

double eastwards(const Waters& waters) {
  const double x = 50.0, y = 50.0;
  double u = 0.0, v = 0.0;
  waters.field.sample(0.0, waters.frame.grid_from_mission, false, {&x, 1}, {&y, 1}, {&u, 1},
                      {&v, 1});
  return u;
}

TEST_F(WatersOf, IsSharedByRequestsForTheSame) {
  const auto one = waters_of(request_);
  EXPECT_EQ(one, waters_of(request_));
  EXPECT_EQ(eastwards(*one), 0.25);
}

TEST_F(WatersOf, IsNotSharedByOtherRequests) {
  const auto one = waters_of(request_);
  WatersRequest other = request_;
  other.origin.x_y = {10.0, 0.0};
  EXPECT_NE(one, waters_of(other));
  other = request_;
  other.u_variable = "u";
  other.v_variable = "v";
  EXPECT_NE(one, waters_of(other));
  other = request_;
  other.clamp = true;
  EXPECT_NE(one, waters_of(other));
}

TEST_F(WatersOf, IsReadAgainWhenTheFileHasChanged) {
  const auto before = waters_of(request_);
  const auto changed = fs::last_write_time(file_);
  write(0.5);
  fs::last_write_time(file_, changed + std::chrono::seconds(1));
  EXPECT_EQ(eastwards(*waters_of(request_)), 0.5);
  EXPECT_EQ(eastwards(*before), 0.25);
}

TEST_F(WatersOf, IsForgottenWithItsLastHolder) {
  const auto changed = fs::last_write_time(file_);
  EXPECT_EQ(eastwards(*waters_of(request_)), 0.25);
  write(0.5);
  fs::last_write_time(file_, changed);  // as if nothing had happened
  EXPECT_EQ(eastwards(*waters_of(request_)), 0.5);
}

TEST_F(WatersOf, IsReadOnceByThreadsThatAskTogether) {
  std::vector<std::shared_ptr<const Waters>> waters(8);
  {
    std::vector<std::jthread> threads;
    for (auto& each : waters) threads.emplace_back([&] { each = waters_of(request_); });
  }
  for (const auto& each : waters) EXPECT_EQ(each, waters[0]);
}

TEST_F(WatersOf, ComplainsOfAMissingFileEveryTime) {
  WatersRequest missing = request_;
  missing.file += ".missing";
  for (int i = 0; i < 2; ++i) EXPECT_THROW(waters_of(missing), InputError);
}

}  // namespace
}  // namespace shoal::scenarios
