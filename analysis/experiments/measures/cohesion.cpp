#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/core/grid_index.hpp"

namespace shoal::analysis {
namespace {

// Up to so many vehicles, looking at every pair is faster than sorting them into a grid.
constexpr std::size_t few = 64;

/// Does the swarm hold together, and how close do two vehicles come?
///
/// Fragments are the connected parts of the graph of vehicles within acoustic range of one another,
/// at the end of the mission. The least separation is over all looks, 5 s apart (every tick where
/// vehicles go to a waypoint or past obstacles), and has no value if no two vehicles ever were
/// within acoustic range.
class Cohesion final : public Measure {
 public:
  static void declare(Options<Cohesion>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"min_separation_m", "m", "closest that two vehicles came"},
        {"fragments", "", "parts of the swarm out of acoustic range of one another, at the end"},
        {"lost_vehicles", "", "vehicles lost"}};
  }

  void begin(const scenarios::World& world) override {
    const bool close = world.scenario().waypoint || !world.obstacles().empty();
    every_s_ = close ? world.scenario().trial.tick_s : log_interval_s(world);
  }

  void observe(const scenarios::World& world) override {
    survivors(world, positions_, slots_);
    split(positions_, x_, y_);
    least_m_ = std::min(least_m_, x_.size() <= few ? least_among_all() : least_among_near(world));
  }

  void finish(const scenarios::World& world, Results& results) const override {
    const bool met = least_m_ <= world.scenario().ping.range_m;
    results.add("min_separation_m", met ? std::optional(least_m_) : std::nullopt);
    results.add("fragments", fragments(world));
    results.add("lost_vehicles", static_cast<double>(world.lost_count()));
  }

 private:
  double least_among_all() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double dx = x_[i] - x_[j], dy = y_[i] - y_[j];
        least = std::min(least, dx * dx + dy * dy);
      }
    }
    return std::sqrt(least);
  }

  // A pair closer than the least so far lies within one cell of that size.
  double least_among_near(const scenarios::World& world) {
    double least = std::numeric_limits<double>::infinity();
    grid_.build(x_, y_, std::clamp(least_m_, 1e-3, world.scenario().ping.range_m));
    for (std::size_t i = 0; i < x_.size(); ++i) {
      grid_.near(x_[i], y_[i], [&](std::size_t j) {
        if (j > i) least = std::min(least, std::hypot(x_[i] - x_[j], y_[i] - y_[j]));
      });
    }
    return least;
  }

  static void split(const std::vector<Eigen::Vector2d>& points, std::vector<double>& x,
                    std::vector<double>& y) {
    x.clear();
    y.clear();
    for (const Eigen::Vector2d& p : points) {
      x.push_back(p.x());
      y.push_back(p.y());
    }
  }

  static int fragments(const scenarios::World& world) {
    std::vector<Eigen::Vector2d> positions;
    std::vector<int> slots;
    std::vector<double> x, y;
    survivors(world, positions, slots);
    split(positions, x, y);
    GridIndex grid;
    const double range = world.scenario().ping.range_m;
    grid.build(x, y, range);

    std::vector<std::size_t> root(x.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    auto parts = static_cast<int>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      grid.near(x[i], y[i], [&](std::size_t j) {
        if (j <= i || (positions[i] - positions[j]).norm() > range) return;
        const std::size_t a = find(i), b = find(j);
        if (a == b) return;
        root[a] = b;
        --parts;
      });
    }
    return parts;
  }

  double least_m_ = std::numeric_limits<double>::infinity();
  GridIndex grid_;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> slots_;
  std::vector<double> x_, y_;
};

const Register<Measure, Cohesion> registered{
    "cohesion", "does the swarm hold together, and how close do vehicles come"};

}  // namespace
}  // namespace shoal::analysis
