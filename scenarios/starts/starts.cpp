#include <cmath>
#include <limits>

#include "shoal/core/angles.hpp"
#include "shoal/core/grid_index.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/starts/start.hpp"

namespace shoal::scenarios {
namespace {

constexpr const char* heading_meaning =
    "compass heading of every vehicle; the author's trials started at 180";

/// Uniform in a square around the origin: Rypkema 2015, sec. 4.4.1.
class BoxStart final : public StartSource {
 public:
  double side_m = 200.0;
  double heading_deg = 180.0;

  static void declare(Options<BoxStart>& o) {
    o.number("side_m", &BoxStart::side_m, "m", in(1, farthest_start_m), "side of the square");
    o.number("heading_deg", &BoxStart::heading_deg, "deg", in(-360, 360), heading_meaning);
  }

  std::vector<Start> place(const formations::Plan& plan,
                           const RandomStreams& random) const override {
    std::vector<Start> starts;
    for (int i = 0; i < plan.size(); ++i) {
      const auto [u, v] = random.uniform(Purpose::start, static_cast<std::uint32_t>(i), 0);
      starts.push_back({(u - 0.5) * side_m, (v - 0.5) * side_m, from_compass_deg(heading_deg)});
    }
    return starts;
  }
};

/// On the slots of the centred plan: Rypkema 2015, sec. 4.4.2.
class PlanStart final : public StartSource {
 public:
  double heading_deg = 180.0;

  static void declare(Options<PlanStart>& o) {
    o.number("heading_deg", &PlanStart::heading_deg, "deg", in(-360, 360), heading_meaning);
  }

  std::vector<Start> place(const formations::Plan& plan, const RandomStreams&) const override {
    std::vector<Start> starts;
    const formations::Plan centred = plan.centred();
    for (const Eigen::Vector2d& slot : centred.slots()) {
      starts.push_back({slot.x(), slot.y(), from_compass_deg(heading_deg)});
    }
    return starts;
  }
};

/// At given points, in the order of the slots.
class PointsStart final : public StartSource {
 public:
  std::vector<Eigen::Vector2d> points;
  double heading_deg = 180.0;
  Origin origin;

  static void declare(Options<PointsStart>& o) {
    o.points("points", &PointsStart::points, "one [x, y] per slot of the plan, in its order");
    o.number("heading_deg", &PointsStart::heading_deg, "deg", in(-360, 360), heading_meaning);
  }

  std::vector<Start> place(const formations::Plan& plan, const RandomStreams&) const override {
    if (points.size() != static_cast<std::size_t>(plan.size())) {
      throw InputError(origin, "swarm.start.points has " + std::to_string(points.size()) +
                                   " points, but the plan has " + std::to_string(plan.size()) +
                                   " slots; give one point per slot");
    }
    std::vector<Start> starts;
    for (const Eigen::Vector2d& p : points) {
      starts.push_back({p.x(), p.y(), from_compass_deg(heading_deg)});
    }
    require_usable(starts, plan, origin);
    return starts;
  }
};

/// On a rectangular grid, row by row from the south-west.
class GridStart final : public StartSource {
 public:
  double x_m = 0.0;
  double y_m = 0.0;
  double spacing_m = 20.0;
  std::int64_t columns = 2;
  double heading_deg = 180.0;
  Origin origin;

  static void declare(Options<GridStart>& o) {
    using G = GridStart;
    o.number("x_m", &G::x_m, "m", {}, "east, of the middle of the grid");
    o.number("y_m", &G::y_m, "m", {}, "north, of the middle");
    o.number("spacing_m", &G::spacing_m, "m", above(0), "distance of rows and of columns");
    o.integer("columns", &G::columns, "", in(1, 1e6),
              "places in a row; the plan must have as many slots as full rows");
    o.number("heading_deg", &G::heading_deg, "deg", in(-360, 360), heading_meaning);
  }

  std::vector<Start> place(const formations::Plan& plan, const RandomStreams&) const override {
    if (plan.size() % columns != 0) {
      throw InputError(origin, "swarm.start.grid has " + std::to_string(columns) +
                                   " columns, which do not divide the plan's " +
                                   std::to_string(plan.size()) + " slots");
    }
    const std::int64_t rows = plan.size() / columns;
    const double middle_column = 0.5 * static_cast<double>(columns - 1);
    const double middle_row = 0.5 * static_cast<double>(rows - 1);
    std::vector<Start> starts;
    for (std::int64_t i = 0; i < plan.size(); ++i) {
      const std::int64_t row = i / columns, column = i % columns;
      starts.push_back({x_m + spacing_m * (static_cast<double>(column) - middle_column),
                        y_m + spacing_m * (static_cast<double>(row) - middle_row),
                        from_compass_deg(heading_deg)});
    }
    require_usable(starts, plan, origin);
    return starts;
  }
};

const Register<StartSource, BoxStart> box{"box", "uniform in a square around the origin"};
const Register<StartSource, PlanStart> on_plan{"plan", "on the slots of the plan, centred"};
const Register<StartSource, GridStart> on_grid{"grid", "on a rectangular grid"};
const Register<StartSource, PointsStart> at_points{"points", "at points given in the scenario"};

}  // namespace

void require_usable(const std::vector<Start>& starts, const formations::Plan& plan,
                    const Origin& origin) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    x.push_back(starts[i].x_m);
    y.push_back(starts[i].y_m);
    if (std::hypot(x[i], y[i]) <= farthest_start_m) continue;
    throw InputError(origin, plan.name(static_cast<int>(i)) + " starts at (" + shortest(x[i]) +
                                 ", " + shortest(y[i]) + "), which is more than " +
                                 shortest(farthest_start_m) +
                                 " m from the origin; give metres from the origin");
  }
  constexpr double coincident_m = 1e-3;
  GridIndex grid;
  grid.build(x, y, 1.0);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    grid.near(x[i], y[i], [&](std::size_t j) {
      if (j <= i || std::hypot(x[i] - x[j], y[i] - y[j]) >= coincident_m) return;
      throw InputError(origin, plan.name(static_cast<int>(i)) + " and " +
                                   plan.name(static_cast<int>(j)) + " both start at (" +
                                   shortest(x[i]) + ", " + shortest(y[i]) + "); move one of them");
    });
  }
}

}  // namespace shoal::scenarios
