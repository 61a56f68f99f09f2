#include "shoal/analysis/reporting/current_arrows.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "shoal/analysis/reporting/known_current.hpp"
#include "shoal/analysis/reporting/packed.hpp"

namespace shoal::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr int along_longer_side = 24;
constexpr int most_instants = 49;

struct GridAxis {
  std::vector<double> places;

  /// Multiples of the spacing, so that neighbouring pages agree.
  GridAxis(double from, double to, double spacing) {
    for (double k = std::floor(from / spacing); k <= std::ceil(to / spacing); ++k) {
      places.push_back(k * spacing);
    }
  }
};

struct Field {
  std::vector<double> x, y, u, v;
};

}  // namespace

Json current_arrows(const scenarios::Current& current, const Region& region, double duration_s) {
  const double side = std::max({region.east - region.west, region.north - region.south, 100.0});
  const double spacing = side / along_longer_side;
  const double beyond = 0.25 * side;
  const GridAxis east(region.west - beyond, region.east + beyond, spacing);
  const GridAxis north(region.south - beyond, region.north + beyond, spacing);
  Field field;
  for (const double y : north.places) {
    for (const double x : east.places) {
      field.x.push_back(x);
      field.y.push_back(y);
    }
  }
  field.u.resize(field.x.size());
  field.v.resize(field.x.size());

  std::vector<double> times, u, v;
  double fastest = 0.0;
  for (int k = 0; k < most_instants; ++k) {
    const double time_s = duration_s * k / (most_instants - 1);
    sample_known(current, time_s, field.x, field.y, field.u, field.v);
    for (std::size_t p = 0; p < field.u.size(); ++p) {
      const double speed = std::hypot(field.u[p], field.v[p]);
      if (std::isfinite(speed)) fastest = std::max(fastest, speed);
    }
    times.push_back(time_s);
    u.insert(u.end(), field.u.begin(), field.u.end());
    v.insert(v.end(), field.v.begin(), field.v.end());
  }
  if (fastest == 0.0) return nullptr;
  return {{"x", east.places},
          {"y", north.places},
          {"spacing", spacing},
          {"fastest", fastest},
          {"times", packed_floats(times)},
          {"u", packed_levels(u)},
          {"v", packed_levels(v)}};
}

}  // namespace shoal::analysis
