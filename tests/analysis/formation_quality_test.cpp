#include "shoal/analysis/experiments/measures/formation_quality.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "shoal/core/angles.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

using Alignment = scenarios::QualityOptions::Alignment;
using Points = std::vector<Eigen::Vector2d>;
using Complex = std::complex<double>;

constexpr double step_deg = 10.0;
constexpr Alignment alignments[] = {Alignment::centroid, Alignment::nearest_point};
constexpr double tolerance_m = scenarios::QualityOptions{}.tolerance_m;

std::unique_ptr<formations::PlanSource> plan_source(const std::vector<std::string>& settings) {
  Setting root;
  for (const std::string& setting : settings) scenarios::apply_set(root, setting);
  return scenarios::read_scenario(root).plan.make();
}

const formations::PlanSource& lattice() {
  static const auto source =
      plan_source({"plan.square.rows=5", "plan.square.columns=4", "plan.square.separation_m=300"});
  return *source;
}

formations::Plan letters() {
  return plan_source({"plan.kind=letters"})->plan();
}

Points slots_of(const formations::Plan& plan) {
  return {plan.slots().begin(), plan.slots().end()};
}

Points moved(Points points, double degrees_ccw, const Eigen::Vector2d& by) {
  const Transform2 T = Transform2::from_angle(radians(degrees_ccw), by);
  for (Eigen::Vector2d& p : points) p = T * p;
  return points;
}

Points scattered(Points points, double sd_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sd_m);
  for (Eigen::Vector2d& p : points) p += Eigen::Vector2d(noise(random), noise(random));
  return points;
}

double quality(const formations::Plan& plan, Alignment alignment, const Points& positions) {
  scenarios::QualityOptions options;
  options.alignment = alignment;
  options.delta_theta_deg = step_deg;
  return FormationQuality(plan, options).of(positions).quality_m;
}

// The measure by the two recipes of the thesis once more, by a plain loop over all turns, the
// Hungarian method and complex numbers; nothing is shared with the solvers.

std::vector<Complex> complex(const Points& points) {
  std::vector<Complex> z;
  for (const Eigen::Vector2d& p : points) z.emplace_back(p.x(), p.y());
  return z;
}

Complex mean(const std::vector<Complex>& z) {
  return std::accumulate(z.begin(), z.end(), Complex(0)) / static_cast<double>(z.size());
}

Complex centre(const std::vector<Complex>& z, Alignment alignment) {
  const Complex m = mean(z);
  if (alignment == Alignment::centroid) return m;
  return *std::ranges::min_element(z, {}, [&](const Complex& p) { return std::abs(p - m); });
}

/// The columns of rows in the cheapest assignment, by augmenting along shortest paths.
std::vector<std::size_t> hungarian(const std::vector<std::vector<double>>& cost) {
  const std::size_t rows = cost.size(), columns = cost[0].size();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> u(rows + 1), v(columns + 1);
  std::vector<std::size_t> row_of(columns + 1), way(columns + 1);
  for (std::size_t i = 1; i <= rows; ++i) {
    row_of[0] = i;
    std::size_t j0 = 0;
    std::vector<double> least(columns + 1, infinity);
    std::vector<bool> used(columns + 1);
    do {
      used[j0] = true;
      std::size_t j1 = 0;
      double delta = infinity;
      for (std::size_t j = 1; j <= columns; ++j) {
        if (used[j]) continue;
        const double reduced = cost[row_of[j0] - 1][j - 1] - u[row_of[j0]] - v[j];
        if (reduced < least[j]) {
          least[j] = reduced;
          way[j] = j0;
        }
        if (least[j] < delta) {
          delta = least[j];
          j1 = j;
        }
      }
      for (std::size_t j = 0; j <= columns; ++j) {
        if (used[j]) {
          u[row_of[j]] += delta;
          v[j] -= delta;
        } else {
          least[j] -= delta;
        }
      }
      j0 = j1;
    } while (row_of[j0] != 0);
    for (; j0 != 0; j0 = way[j0]) row_of[j0] = row_of[way[j0]];
  }
  std::vector<std::size_t> column_of(rows);
  for (std::size_t j = 1; j <= columns; ++j) {
    if (row_of[j] != 0) column_of[row_of[j] - 1] = j - 1;
  }
  return column_of;
}

double plain_quality(const formations::Plan& plan, Alignment alignment, const Points& positions) {
  const std::vector<Complex> slots = complex(slots_of(plan)), seen = complex(positions);
  const Complex slot_centre = centre(slots, alignment), seen_centre = centre(seen, alignment);
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> slot_of;
  for (int turn = 0; turn < 36; ++turn) {
    const Complex rotation = std::polar(1.0, turn * std::numbers::pi / 18.0);
    std::vector<std::vector<double>> cost;
    for (const Complex& p : seen) {
      std::vector<double>& row = cost.emplace_back();
      for (const Complex& s : slots) {
        row.push_back(std::abs(p - seen_centre - rotation * (s - slot_centre)));
      }
    }
    const std::vector<std::size_t> columns = hungarian(cost);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) sum += cost[i][columns[i]];
    if (sum < least - 1e-6) {
      least = sum;
      slot_of = columns;
    }
  }
  std::vector<Complex> taken;
  for (const std::size_t j : slot_of) taken.push_back(slots[j]);
  const Complex from = mean(taken), to = mean(seen);
  Complex correlation = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    correlation += std::conj(taken[i] - from) * (seen[i] - to);
  }
  const Complex rotation = correlation / std::abs(correlation);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += std::abs(rotation * (taken[i] - from) + to - seen[i]);
  }
  return sum / static_cast<double>(seen.size());
}

TEST(FormationQuality, IsZeroForThePerfectFormationInAnyPose) {
  EXPECT_TRUE(rc::check("perfect formation", [] {
    const double turn = *rc::gen::inRange(0, 3600) / 10.0;
    const Eigen::Vector2d by(*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000));
    for (const Alignment alignment : alignments) {
      const Points on_lattice = moved(slots_of(lattice().plan()), turn, by);
      RC_ASSERT(quality(lattice().plan(), Alignment::centroid, on_lattice) < 1e-9);
      RC_ASSERT(quality(lattice().padded(1), alignment, on_lattice) < 1e-9);
      RC_ASSERT(quality(letters(), alignment, moved(slots_of(letters()), turn, by)) < 1e-9);
    }
  }));
}

TEST(FormationQuality, IsAboutTheErrorOfSmallErrors) {
  // 20 vehicles, each off by 5 m in both axes: 5 m * sqrt(pi / 2) on average, less what the
  // registration takes up.
  const Points off = scattered(slots_of(lattice().plan()), 5.0, 1);
  const double error = quality(lattice().padded(1), Alignment::centroid, off);
  EXPECT_GT(error, 4.0);
  EXPECT_LT(error, 8.0);
}

TEST(FormationQuality, AgreesWithAPlainLoopOverAllRotations) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const double sd_m = 20.0 * seed;
    const Points swarm = moved(scattered(slots_of(lattice().plan()), sd_m, seed), 13.0 * seed,
                               {100.0 * seed, -50.0});
    const Points written =
        moved(scattered(slots_of(letters()), sd_m / 4, seed), 31.0 * seed, {0.0, 0.0});
    for (const Alignment alignment : alignments) {
      for (const int layers : {0, 1, 2}) {
        const formations::Plan plan = lattice().padded(layers);
        EXPECT_NEAR(quality(plan, alignment, swarm), plain_quality(plan, alignment, swarm), 1e-9)
            << "seed " << seed << ", " << layers << " layers";
      }
      EXPECT_NEAR(quality(letters(), alignment, written),
                  plain_quality(letters(), alignment, written), 1e-9);
    }
  }
}

TEST(FormationQuality, AgreesWithThePlainLoopWhenVehiclesAreLost) {
  for (const std::size_t left : {1u, 2u, 3u, 7u, 15u}) {
    Points swarm = scattered(slots_of(lattice().plan()), 60.0, 7);
    std::ranges::shuffle(swarm, std::mt19937(3));
    swarm.resize(left);
    for (const Alignment alignment : alignments) {
      const formations::Plan plan = lattice().padded(1);
      if (left == 1) {
        EXPECT_EQ(quality(plan, alignment, swarm), 0.0);
        continue;
      }
      EXPECT_NEAR(quality(plan, alignment, swarm), plain_quality(plan, alignment, swarm), 1e-9);
    }
  }
}

TEST(FormationQuality, StaysZeroWhenOneOfManyIsLost) {
  for (std::size_t lost = 0; lost < 20; ++lost) {
    Points left = moved(slots_of(lattice().plan()), 70.0, {10.0, 20.0});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(lost));
    for (const Alignment alignment : alignments) {
      EXPECT_LT(quality(lattice().padded(1), alignment, left), 1e-9) << lost;
    }
  }
}

TEST(FormationQuality, StaysZeroWhateverIsLostOfAPerfectFormation) {
  EXPECT_TRUE(rc::check("survivors", [] {
    Points left = moved(slots_of(lattice().plan()), *rc::gen::inRange(0, 3600) / 10.0,
                        {*rc::gen::inRange(-5000, 5000) * 1.0, 70.0});
    std::ranges::shuffle(left, std::mt19937(*rc::gen::arbitrary<unsigned>()));
    left.resize(static_cast<std::size_t>(*rc::gen::inRange(1, 21)));
    RC_ASSERT(quality(lattice().padded(1), Alignment::rigid, left) < 1e-6);
  }));
}

TEST(FormationQuality, IsNotAboveThatOfTheOtherRecipes) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Points swarm = moved(scattered(slots_of(lattice().plan()), 10.0 * seed, seed), 31.0 * seed,
                         {100.0 * seed, -50.0});
    swarm.resize(20 - seed % 4);
    const formations::Plan plan = lattice().padded(1);
    const double rigid = quality(plan, Alignment::rigid, swarm);
    for (const Alignment alignment : alignments) {
      EXPECT_LE(rigid, quality(plan, alignment, swarm) + tolerance_m) << "seed " << seed;
    }
  }
}

TEST(FormationQuality, IsProvenForAFormedSwarm) {
  const Points off = scattered(slots_of(lattice().plan()), 8.0, 1);
  FormationQuality measure(lattice().padded(1), {});
  const FormationQuality::Value value = measure.of(off);
  ASSERT_TRUE(value.lower_bound_m);
  EXPECT_LT(value.quality_m - *value.lower_bound_m, tolerance_m + 1e-12);
  EXPECT_GT(*value.lower_bound_m, 7.0);
  EXPECT_EQ(measure.slot_of_position().size(), off.size());
}

TEST(FormationQuality, FollowsASwarmThatDriftsAndLosesVehicles) {
  FormationQuality measure(lattice().padded(1), {});
  Points swarm = scattered(slots_of(lattice().plan()), 8.0, 3);
  for (int k = 0; k < 10; ++k) {
    swarm = moved(scattered(swarm, 1.0, static_cast<unsigned>(k)), 2.0, {400.0, -90.0});
    if (k % 2) swarm.erase(swarm.begin());
    EXPECT_NEAR(measure.of(swarm).quality_m, quality(lattice().padded(1), Alignment::rigid, swarm),
                tolerance_m);
  }
}

TEST(FormationQuality, DoesNotCountTheMirrorImage) {
  Points mirrored = slots_of(letters());
  for (Eigen::Vector2d& p : mirrored) p.x() = -p.x();
  for (const Alignment alignment : alignments) {
    EXPECT_GT(quality(letters(), alignment, mirrored), 20.0);
  }
  EXPECT_GT(quality(letters(), Alignment::rigid, mirrored), 10.0);
}

TEST(FormationQuality, DoesNotDependOnWhichVehicleIsWhere) {
  EXPECT_TRUE(rc::check("relabelling", [](unsigned seed) {
    Points swarm = scattered(slots_of(lattice().plan()), 80.0, seed);
    const double before = quality(lattice().padded(1), Alignment::centroid, swarm);
    std::ranges::shuffle(swarm, std::mt19937(seed));
    const double after = quality(lattice().padded(1), Alignment::centroid, swarm);
    RC_ASSERT(std::abs(before - after) < 1e-9);
  }));
}

TEST(FormationQuality, DoesNotDependOnWhatWasMeasuredBefore) {
  scenarios::QualityOptions options;
  options.alignment = Alignment::centroid;
  FormationQuality one(lattice().padded(1), options);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Points swarm =
        moved(scattered(slots_of(lattice().plan()), 150.0, seed), 47.0 * seed, {0.0, 0.0});
    EXPECT_EQ(one.of(swarm).quality_m, quality(lattice().padded(1), Alignment::centroid, swarm));
  }
}

}  // namespace
}  // namespace shoal::analysis
