#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// Do vehicles at the edge of the swarm sit wider than those inside (Rypkema 2015, sec. 3.4)? The
/// mean distance of the two nearest neighbours, of the half of the vehicles that is farther from
/// the centroid and of the half that is nearer, at the end.
class Spacing final : public Measure {
 public:
  static void declare(Options<Spacing>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"spacing_m", "m", "distance of the two nearest neighbours, mean of vehicles, at the end"},
        {"spacing_outer_over_inner", "",
         "the same of the outer half of the vehicles / of the inner half"}};
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::vector<Eigen::Vector2d> places;
    std::vector<int> vehicles;
    survivors(world, places, vehicles);
    if (places.size() < 4) {
      for (const Quantity& quantity : values()) results.add(quantity.name, std::nullopt);
      return;
    }
    const Eigen::Vector2d centroid = mean_of(places);
    std::ranges::sort(places, {}, [&](const auto& p) { return (p - centroid).squaredNorm(); });
    std::vector<double> distances;
    for (const Eigen::Vector2d& place : places) distances.push_back(to_two_nearest(place, places));
    // The one in the middle, if there is one, is neither.
    const auto half = static_cast<std::ptrdiff_t>(places.size() / 2);
    const double inner = mean(distances.begin(), distances.begin() + half);
    const double outer = mean(distances.end() - half, distances.end());
    results.add("spacing_m", mean(distances.begin(), distances.end()));
    results.add("spacing_outer_over_inner",
                inner > 0.0 ? std::optional(outer / inner) : std::nullopt);
  }

 private:
  static double mean(std::vector<double>::const_iterator first,
                     std::vector<double>::const_iterator last) {
    return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
  }

  static double to_two_nearest(const Eigen::Vector2d& place,
                               const std::vector<Eigen::Vector2d>& places) {
    // The place itself is one of them, at no distance.
    std::array<double, 3> nearest;
    nearest.fill(std::numeric_limits<double>::infinity());
    for (const Eigen::Vector2d& other : places) {
      double distance = (other - place).norm();
      for (double& least : nearest) {
        if (distance < least) std::swap(distance, least);
      }
    }
    return 0.5 * (nearest[1] + nearest[2]);
  }
};

const Register<Measure, Spacing> registered{"spacing",
                                            "do vehicles at the edge sit wider than those inside"};

}  // namespace
}  // namespace shoal::analysis
