#include <gtest/gtest.h>

#include "shoal/scenarios/currents/netcdf_report.hpp"
#include "tests/support/current_files.hpp"
#include "tests/support/shared_data.hpp"

namespace shoal::scenarios {
namespace {

using namespace current_files;

// --- public files ----------------------------------------------------------------------------

TEST(PublicCurrents, RedSeaReconstructionIsRead) {
  const fs::path path = tests::shared_data("redsea_current.nc");
  SHOAL_NEEDS_SHARED(path);
  const auto water = open(path, {{"time_offset_s", plain(59.0)}});
  EXPECT_NO_THROW(water->require_duration(18000.0));
  EXPECT_THROW(water->require_duration(18142.0), InputError);
  // By an independent reading with numpy: time 100 s, nodes (0, 200) and (200, 200).
  const Vector2d velocity = at(*water, 41.0, 100, 200);
  EXPECT_LT((velocity - Vector2d(-0.070015, 0.054145)).norm(), float_rounding);
  // Its axes are east and north of the same origin that its longitudes and latitudes tell.
  const auto placed =
      open(path, {{"origin", origin_at(35.45, 27.38)}, {"time_offset_s", plain(59.0)}});
  EXPECT_LT((at(*placed, 41.0, 100, 200) - velocity).norm(), 1e-6);
  EXPECT_SAYS(describe_current_file(path), "183 steps over 18200 s, step 100 s");
}

TEST(PublicCurrents, CoastalAltimetryIsRead) {
  const fs::path path = tests::shared_data("ocean/redsea_duacs_geostrophic_20190223.nc");
  SHOAL_NEEDS_SHARED(path);
  EXPECT_SAYS(refusal(path, {{"origin", origin_at(37.5, 21)}}),
              "a single time, 2019-02-23T00:00:00Z");
  const auto water = open(path, {{"origin", origin_at(37.625, 21.125)}, {"outside", clamp}});
  EXPECT_LT((at(*water, 1e5, 0, 0) - Vector2d(0.1439, -0.1343)).norm(), float_rounding);
  EXPECT_SAYS(describe_current_file(path), "84.0 % of 3552 values");
}

TEST(PublicCurrents, PolarStereographicModelIsRead) {
  const fs::path path = tests::shared_data("ocean/metno_arctic20_roms_polarstereo_201702.nc");
  SHOAL_NEEDS_SHARED(path);
  EXPECT_SAYS(describe_current_file(path), "along the grid's x and y axes, not east and north");
  EXPECT_SAYS(describe_current_file(path), "one level, at 0 m");
  const Changes origin{{"origin_x_m", plain(-2760000.0)}, {"origin_y_m", plain(-2010000.0)}};
  const Vector2d along_grid = at(*open(path, origin), 5400, 0, 0);
  EXPECT_LT((along_grid - Vector2d(0.07552028819918633, 0.059018904343247414)).norm(),
            float_rounding);
  // At 3 E, 58 E being straight down, the grid's x axis points 55 degrees north of east.
  const auto turned = open(path, {{"origin", origin_at(3, 60)}});
  const double angle = 55.0 * M_PI / 180.0;
  const Vector2d placed =
      at(*open(path, {{"origin_x_m", plain(-2609408.837)}, {"origin_y_m", plain(-1827127.738)}}),
         5400, 0, 0);
  const Vector2d expected(std::cos(angle) * placed.x() - std::sin(angle) * placed.y(),
                          std::sin(angle) * placed.x() + std::cos(angle) * placed.y());
  EXPECT_LT((at(*turned, 5400, 0, 0) - expected).norm(), 1e-3);
}

TEST(PublicCurrents, CurvilinearStaggeredModelIsRefused) {
  const fs::path path = tests::shared_data("ocean/noaa_wcofs_roms_curvilinear.nc");
  SHOAL_NEEDS_SHARED(path);
  const std::string why = complaint([&] { describe_current_file(path); });
  EXPECT_SAYS(why, "a staggered (Arakawa C) grid, and a curvilinear one");
}

}  // namespace
}  // namespace shoal::scenarios
