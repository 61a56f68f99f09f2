#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "shoal/core/random.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const char* const pair_forces_kind = "pair_forces";

// One vehicle, computed by hand -------------------------------------------------------------------

Vector2d force(const Behaviour& made, const Neighbours& seen, const OwnState& own = {},
               int slot = 0) {
  return *made.step({seen, slot, own}, unused_plan).force_m_s2;
}

TEST(PairForces, AreThoseOfPhysicomimeticsWithFriction) {
  const auto made = behaviour(pair_forces_kind, {{"strength_m_s2", 0.02}, {"friction_per_s", 0.1}});
  // (300 / 400)^2 towards the one, (300 / 250)^2 away from the other.
  const Neighbours seen{{{400, 0}, 0.0, 1}, {{0, 250}, 0.0, 2}};
  EXPECT_LT((force(*made, seen) - 0.02 * Vector2d(0.5625, -1.44)).norm(), 1e-12);
  const OwnState moving{.velocity = {1.0, -2.0}};
  EXPECT_LT(
      (force(*made, seen, moving) - 0.02 * Vector2d(0.5625, -1.44) - Vector2d(-0.1, 0.2)).norm(),
      1e-12);
}

TEST(PairForces, EndAtTheRangeOfTheSource) {
  const auto made = behaviour(pair_forces_kind);
  EXPECT_GT(force(*made, {{{449.9, 0}, 0.0, 1}}).x(), 0.0);
  EXPECT_EQ(made->step({Neighbours{{{450.1, 0}, 0.0, 1}}, 0}, unused_plan).reason,
            Reason::no_neighbour);
}

TEST(PairForces, TakeTheDistanceOfLikeVehiclesOverTheRootOfTwoForSquares) {
  const auto made =
      behaviour(pair_forces_kind, {{"lattice", "squares"}, {"contact_rangeout_m", 510.0}});
  EXPECT_NEAR(force(*made, {{{500, 0}, 0.0, 2}}).x(), 0.01 * 0.72, 1e-12);  // 2 (300 / 500)^2
  EXPECT_NEAR(force(*made, {{{500, 0}, 0.0, 1}}).x(), 0.01 * 0.36, 1e-12);
  EXPECT_NEAR(force(*made, {{{400, 0}, 0.0, 2}}).x(), -0.01 * 1.125, 1e-12);  // 2 (300 / 400)^2
  EXPECT_NEAR(force(*made, {{{400, 0}, 0.0, 3}}, {}, 1).x(), -0.01 * 1.125, 1e-12);
  EXPECT_NEAR(force(*made, {{{300 * std::sqrt(2.0), 0}, 0.0, 2}}).x(), 0.0, 1e-12);
  EXPECT_TRUE(made->needs_ids());
  EXPECT_EQ(made->step({Neighbours{{{300, 0}, 0.0, anonymous}}, 0}, unused_plan).reason,
            Reason::no_neighbour);
}

TEST(PairForces, HaveNoDirectionOnTopOfANeighbour) {
  const Neighbours seen{{{0, 0}, 0.0, 1}};
  EXPECT_EQ(behaviour(pair_forces_kind)->step({seen, 0}, unused_plan).reason, Reason::degenerate);
}

class LatticeOfPairForces : public testing::TestWithParam<std::string> {};

TEST_P(LatticeOfPairForces, AreTheGradientOfTheCost) {
  const auto made = behaviour(pair_forces_kind, {{"lattice", GetParam()},
                                                 {"potential.kind", "thesis"},
                                                 {"contact_rangeout_m", 1e4},
                                                 {"strength_m_s2", 1.0}});
  EXPECT_TRUE(rc::check("central differences", [&] {
    const Plan plan = drawn_plan(2, 8);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = heard(plan, own);
    for (const Neighbour& n : seen) RC_PRE(n.position.norm() > 30.0);
    const auto cost = [&](const Vector2d& moved) {
      return made->step({heard(plan, own, {}, moved), own}, plan).cost;
    };
    const double h = 1e-3;
    const Vector2d gradient{(cost({h, 0}) - cost({-h, 0})) / (2 * h),
                            (cost({0, h}) - cost({0, -h})) / (2 * h)};
    const Vector2d f = force(*made, seen, {}, own);
    RC_ASSERT((f + gradient).norm() < 1e-4 * (1.0 + f.norm()));
  }));
}

TEST_P(LatticeOfPairForces, TurnWithTheSwarm) {
  const auto made =
      behaviour(pair_forces_kind, {{"lattice", GetParam()}, {"contact_rangeout_m", 1e4}});
  EXPECT_TRUE(rc::check("and with the own velocity", [&] {
    const Plan plan = drawn_plan(2, 8);
    const Neighbours seen = heard(plan, 0);
    const Transform2 turn = rotation(drawn_angle());
    const OwnState own{.velocity = {0.4, -0.3}}, other{.velocity = turn.rotate(own.velocity)};
    const Vector2d f = force(*made, seen, own);
    RC_ASSERT((force(*made, turned(seen, turn), other) - turn.rotate(f)).norm() <
              1e-9 * (1.0 + f.norm()));
  }));
}

INSTANTIATE_TEST_SUITE_P(Lattices, LatticeOfPairForces, testing::Values("triangles", "squares"),
                         [](const auto& tested) { return tested.param; });

// A closed swarm of particles ---------------------------------------------------------------------

/// Particles of unit mass that move as their behaviour says: the equations of the sources, without
/// pings or hulls.
class Particles {
 public:
  Particles(Points places, std::shared_ptr<const Behaviour> behaviour)
      : places_(std::move(places)),
        velocities_(places_.size(), Vector2d::Zero()),
        behaviour_(std::move(behaviour)) {}

  /// One step of the classical Runge-Kutta method.
  void advance(double dt) {
    const Points x = places_, v = velocities_;
    const std::array<double, 4> along{0.0, 0.5 * dt, 0.5 * dt, dt}, weight{1, 2, 2, 1};
    Points dx(x.size(), Vector2d::Zero()), dv = dx, at = x, speed = v;
    Points a;
    for (std::size_t stage = 0; stage < 4; ++stage) {
      if (stage > 0) {
        for (std::size_t i = 0; i < x.size(); ++i) {
          at[i] = x[i] + along[stage] * speed[i];
          speed[i] = v[i] + along[stage] * a[i];
        }
      }
      a = accelerations(at, speed);
      for (std::size_t i = 0; i < x.size(); ++i) {
        dx[i] += weight[stage] / 6.0 * dt * speed[i];
        dv[i] += weight[stage] / 6.0 * dt * a[i];
      }
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      places_[i] += dx[i];
      velocities_[i] += dv[i];
    }
  }

  double kinetic() const {
    double sum = 0.0;
    for (const Vector2d& v : velocities_) sum += 0.5 * v.squaredNorm();
    return sum;
  }
  /// Every pair is felt by both.
  double potential(double strength) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < places_.size(); ++i) sum += seen_by(i, places_, velocities_).cost;
    return 0.5 * strength * sum;
  }
  Vector2d momentum() const {
    Vector2d sum = Vector2d::Zero();
    for (const Vector2d& v : velocities_) sum += v;
    return sum;
  }
  const Points& places() const { return places_; }

 private:
  Points accelerations(const Points& at, const Points& speed) const {
    Points a;
    for (std::size_t i = 0; i < at.size(); ++i) {
      a.push_back(seen_by(i, at, speed).force_m_s2.value_or(Vector2d::Zero()));
    }
    return a;
  }

  Target seen_by(std::size_t i, const Points& at, const Points& speed) const {
    Neighbours seen;
    for (std::size_t j = 0; j < at.size(); ++j) {
      if (j != i) seen.push_back({at[j] - at[i], 0.0, static_cast<int>(j)});
    }
    return behaviour_->step({seen, static_cast<int>(i), {.velocity = speed[i]}}, unused_plan);
  }

  Points places_, velocities_;
  std::shared_ptr<const Behaviour> behaviour_;
};

/// Up to `by_m` east, west, north or south of each place.
Points scattered(Points places, double by_m, std::uint64_t seed) {
  const RandomStreams random(seed);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto u = random.uniform(Purpose::start, static_cast<std::uint32_t>(i), 0);
    places[i] += by_m * Vector2d(2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
  }
  return places;
}

Points lattice_of(int columns, int rows) {
  const Plan plan = square_lattice(columns, rows, 300.0);
  return {plan.slots().begin(), plan.slots().end()};
}

class ClosedSwarm : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(ClosedSwarm, ConservesItsEnergyAndMomentumWithoutFriction) {
  const auto [potential, lattice] = GetParam();
  const std::shared_ptr<const Behaviour> made =
      behaviour(pair_forces_kind, {{"potential.kind", potential},
                                   {"lattice", lattice},
                                   {"contact_rangeout_m", 1e5},
                                   {"friction_per_s", 0.0}});
  Particles swarm(scattered(lattice_of(3, 2), 90.0, 5), made);
  const double energy = swarm.potential(0.01);
  double moving = 0.0;
  for (int k = 0; k < 1000; ++k) {
    swarm.advance(0.5);
    moving = std::max(moving, swarm.kinetic());
    ASSERT_NEAR(swarm.kinetic() + swarm.potential(0.01), energy, 1e-4 * moving + 1e-9) << k;
  }
  EXPECT_GT(moving, 0.1);
  EXPECT_LT(swarm.momentum().norm(), 1e-9);
}

TEST_P(ClosedSwarm, LosesEnergyToFrictionAllTheTimeAndComesToRest) {
  const auto [potential, lattice] = GetParam();
  const std::shared_ptr<const Behaviour> made =
      behaviour(pair_forces_kind, {{"potential.kind", potential},
                                   {"lattice", lattice},
                                   {"contact_rangeout_m", 1e5},
                                   {"friction_per_s", 0.05}});
  Particles swarm(scattered(lattice_of(3, 2), 90.0, 5), made);
  double energy = swarm.potential(0.01), lost = 0.0, moving = 0.0;
  const double from = energy;
  for (int k = 0; k < 12'000; ++k) {
    const double before = swarm.kinetic();
    swarm.advance(1.0);
    moving = std::max(moving, swarm.kinetic());
    const double now = swarm.kinetic() + swarm.potential(0.01);
    ASSERT_LE(now, energy + 1e-10 * std::abs(from)) << k;
    lost += 0.05 * (before + swarm.kinetic());  // friction v^2 dt, by trapezia
    energy = now;
  }
  EXPECT_NEAR(from - energy, lost, 0.01 * lost);
  EXPECT_LT(swarm.kinetic(), 1e-6 * moving);
}

INSTANTIATE_TEST_SUITE_P(Potentials, ClosedSwarm,
                         testing::Combine(testing::Values("thesis", "virtual_spring",
                                                          "gazi_passino_unbounded"),
                                          testing::Values("triangles", "squares")),
                         [](const auto& tested) {
                           return std::string(std::get<0>(tested.param)) + "_" +
                                  std::get<1>(tested.param);
                         });

// Lattices ----------------------------------------------------------------------------------------

/// How well the neighbours within 1.2 separations stand `fold` times around a vehicle, 0 to 1: the
/// mean of |mean exp(i fold angle)|.
double order(const Points& places, int fold) {
  double sum = 0.0;
  for (const Vector2d& own : places) {
    std::complex<double> mean = 0.0;
    int bonds = 0;
    for (const Vector2d& other : places) {
      const Vector2d away = other - own;
      if (away.norm() == 0.0 || away.norm() > 360.0) continue;
      mean += std::polar(1.0, fold * std::atan2(away.y(), away.x()));
      ++bonds;
    }
    if (bonds > 0) sum += std::abs(mean) / bonds;
  }
  return sum / static_cast<double>(places.size());
}

Particles after(int seconds, const Points& start, const char* lattice, double range_m) {
  Particles swarm(
      start, behaviour(pair_forces_kind, {{"lattice", lattice}, {"contact_rangeout_m", range_m}}));
  for (int k = 0; k < seconds; ++k) swarm.advance(1.0);
  return swarm;
}

TEST(PairForces, HealALatticeOfSquaresOfTwoKinds) {
  const Points start = scattered(lattice_of(5, 4), 75.0, 3);
  const Particles swarm = after(3000, start, "squares", 510.0);
  const Points& places = swarm.places();
  EXPECT_LT(swarm.kinetic(), 1e-4);
  int sides = 0, diagonals = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double r = (places[i] - places[j]).norm();
      if (r > 510.0) continue;
      const bool like = (i - j) % 2 == 0;
      EXPECT_NEAR(r, like ? 300.0 * std::sqrt(2.0) : 300.0, 6.0) << "within 2 %";
      (like ? diagonals : sides) += 1;
    }
  }
  EXPECT_EQ(sides, 4 * 4 + 5 * 3);  // of 5 x 4
  EXPECT_EQ(diagonals, 2 * 4 * 3);
}

// From anywhere both form pieces of their lattice, with faults between them, as in the sources.
TEST(PairForces, LeadTwoKindsToSquaresAndOneKindToTriangles) {
  double squares4 = 0.0, squares6 = 0.0, triangles4 = 0.0, triangles6 = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Points start = scattered(Points(16, Vector2d::Zero()), 400.0, seed);
    const Points squares = after(2000, start, "squares", 510.0).places();
    squares4 += order(squares, 4);
    squares6 += order(squares, 6);
    const Points triangles = after(2000, start, "triangles", 450.0).places();
    triangles4 += order(triangles, 4);
    triangles6 += order(triangles, 6);
  }
  EXPECT_GT(squares4, 1.5 * squares6);
  EXPECT_GT(triangles6, 1.5 * triangles4);
}

}  // namespace
}  // namespace shoal::formations
