#include "shoal/formations/potential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

constexpr double separations[] = {0.5, 30.0, 300.0};

/// Every registered potential with its defaults: a new one is tested by being there.
class EveryPotential : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Potential> potential =
      Registry<Potential>::instance().make(GetParam(), Setting{}, "test");
};

TEST_P(EveryPotential, HasTheDerivativesOfItsValue) {
  for (const double s : separations) {
    for (const double share : {0.6, 0.95, 1.0, 1.3, 2.0, 4.0}) {
      const double r = share * s;
      const double h = 1e-4 * r;
      const auto f = [&](double x) { return potential->value(x, s); };
      const RadialValue exact = potential->derivatives(r, s);
      // Differences of fourth order: what is left is rounding, of value / h and value / h^2.
      const double slope = (8 * (f(r + h) - f(r - h)) - (f(r + 2 * h) - f(r - 2 * h))) / (12 * h);
      const double curvature =
          (16 * (f(r + h) + f(r - h)) - (f(r + 2 * h) + f(r - 2 * h)) - 30 * f(r)) / (12 * h * h);
      const double size =
          std::abs(f(r)) + std::abs(exact.slope) * r + std::abs(exact.curvature) * r * r;
      EXPECT_NEAR(exact.value, f(r), 1e-14 * size);
      EXPECT_NEAR(exact.slope, slope, 1e-10 * size / r) << "r = " << r << ", s = " << s;
      EXPECT_NEAR(exact.curvature, curvature, 1e-6 * size / (r * r))
          << "r = " << r << ", s = " << s;
    }
  }
}

TEST_P(EveryPotential, IsLowestAtTheSeparation) {
  for (const double s : separations) {
    const double least = potential->value(s, s);
    EXPECT_NEAR(potential->derivatives(s, s).slope, 0.0, 1e-12);
    EXPECT_GT(potential->derivatives(s, s).curvature, 0.0);
    for (int i = 10; i <= 500; ++i) {
      const double r = 0.01 * i * s;
      if (i != 100) {
        EXPECT_GT(potential->value(r, s), least) << "r = " << r << ", s = " << s;
      }
    }
  }
}

TEST_P(EveryPotential, PushesOutwardsInsideAndInwardsOutside) {
  for (const double s : separations) {
    for (int i = 10; i <= 500; ++i) {
      if (i == 100) continue;
      const double slope = potential->derivatives(0.01 * i * s, s).slope;
      EXPECT_TRUE(i < 100 ? slope < 0.0 : slope > 0.0) << "r/s = " << 0.01 * i;
    }
  }
}

TEST_P(EveryPotential, IsFiniteFromMillimetresToThousandsOfKilometres) {
  for (const double s : separations) {
    for (double r = 1e-3; r < 1e7; r *= 1.7) {
      const RadialValue f = potential->derivatives(r, s);
      EXPECT_TRUE(std::isfinite(f.value) && std::isfinite(f.slope) && std::isfinite(f.curvature))
          << "r = " << r << ", s = " << s;
    }
  }
}

TEST_P(EveryPotential, IsPreparedForASeparationWithoutChangingANumber) {
  const auto prepared = Registry<Potential>::instance().make(GetParam(), Setting{}, "test");
  for (const double s : separations) {
    EXPECT_EQ(prepared->complaint(s), std::nullopt);
    prepared->prepare(s);
    for (const double r : {0.3 * s, s, 7.7 * s}) {
      EXPECT_EQ(prepared->value(r, s), potential->value(r, s));
      EXPECT_EQ(prepared->derivatives(r, s).slope, potential->derivatives(r, s).slope);
      EXPECT_EQ(prepared->derivatives(r, s).curvature, potential->derivatives(r, s).curvature);
      EXPECT_EQ(prepared->value(r, 1.1 * s), potential->value(r, 1.1 * s));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Potentials, EveryPotential,
                         testing::ValuesIn(Registry<Potential>::instance().names()),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

TEST(ThesisPotential, HasTheValuesOfEquation33) {
  const auto thesis = Registry<Potential>::instance().make("thesis", Setting{}, "test");
  EXPECT_DOUBLE_EQ(thesis->value(300.0, 300.0), -450.0);  // -1.5 s
  EXPECT_DOUBLE_EQ(thesis->value(150.0, 300.0), -150.0);  // 600 + 150 - 900
  EXPECT_DOUBLE_EQ(thesis->value(600.0, 300.0), -262.5);  // 37.5 + 600 - 900
}

TEST(ThesisPotential, AttractsConstantlyFromFarAway) {
  const auto thesis = Registry<Potential>::instance().make("thesis", Setting{}, "test");
  EXPECT_NEAR(thesis->derivatives(3e6, 300.0).slope, 1.0, 1e-11);
  EXPECT_DOUBLE_EQ(thesis->derivatives(150.0, 300.0).slope, -7.0);      // 1 - (s/r)^3
  EXPECT_DOUBLE_EQ(thesis->derivatives(300.0, 300.0).curvature, 0.01);  // 3 s^3 / r^4
}

// The laws of the literature, computed by hand ----------------------------------------------------

using Numbers = std::initializer_list<std::pair<const char*, double>>;

std::unique_ptr<Potential> law(const char* kind, Numbers options = {}) {
  Setting table;
  for (const auto& [name, value] : options) assign(table, name, {value, {}});
  return Registry<Potential>::instance().make(kind, table, "test");
}

/// The force towards the neighbour: the slope.
double force(const Potential& potential, double r, double s = 300.0) {
  return potential.derivatives(r, s).slope;
}

TEST(LennardJones, HasTheWellOfItsDepth) {
  const auto lj = law("lennard_jones", {{"depth_m", 2.0}});
  EXPECT_DOUBLE_EQ(lj->value(300.0, 300.0), -2.0);
  EXPECT_NEAR(lj->value(300.0 / std::pow(2.0, 1.0 / 6.0), 300.0), 0.0, 1e-12);  // at sigma
  EXPECT_DOUBLE_EQ(lj->value(150.0, 300.0), 2.0 * (4096.0 - 2.0 * 64.0));
  EXPECT_NEAR(lj->derivatives(300.0, 300.0).curvature, 72.0 * 2.0 / 9e4, 1e-15);
  EXPECT_DOUBLE_EQ(force(*lj, 600.0), 12.0 * 2.0 / 600.0 * (1.0 / 64.0 - 1.0 / 4096.0));
}

TEST(LennardJones, HardlyAttractsFromFarAway) {
  EXPECT_LT(force(*law("lennard_jones"), 3000.0), 1e-7);
}

TEST(GaziPassinoBounded, IsTheForceOfItsSource) {
  const auto bounded =
      law("gazi_passino_bounded", {{"attraction_per_m", 0.002}, {"repulsion_per_m", 0.04}});
  const double c = 9e4 / std::log(20.0);
  for (const double r : {1.0, 100.0, 250.0, 700.0}) {
    EXPECT_NEAR(force(*bounded, r), r * (0.002 - 0.04 * std::exp(-r * r / c)), 1e-13);
  }
  EXPECT_NEAR(force(*bounded, 6000.0), 12.0, 1e-12);  // linear attraction
}

TEST(GaziPassinoBounded, RepelsWithABound) {
  const auto bounded =
      law("gazi_passino_bounded", {{"attraction_per_m", 0.002}, {"repulsion_per_m", 0.04}});
  const double bound = 0.04 * std::sqrt(0.5 * 9e4 / std::log(20.0) / std::exp(1.0));
  for (int r = 1; r < 300; ++r) EXPECT_GT(force(*bounded, r), -bound);
  EXPECT_NEAR(force(*bounded, 1e-6), 0.0, 1e-7);
}

TEST(GaziPassinoBounded, NeedsMoreRepulsionThanAttraction) {
  try {
    law("gazi_passino_bounded", {{"attraction_per_m", 0.04}, {"repulsion_per_m", 0.04}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "test: repulsion_per_m must be above attraction_per_m, or vehicles attract at any "
                 "distance");
  }
}

TEST(GaziPassinoUnbounded, IsTheForceOfItsSource) {
  const auto unbounded = law("gazi_passino_unbounded", {{"attraction_per_m", 0.01}});
  EXPECT_NEAR(force(*unbounded, 150.0), 1.5 - 0.01 * 9e4 / 150.0, 1e-13);
  EXPECT_NEAR(force(*unbounded, 900.0), 9.0 - 1.0, 1e-13);
  EXPECT_NEAR(force(*unbounded, 1e-3), -9e5, 1e-3);
  EXPECT_DOUBLE_EQ(unbounded->value(300.0, 300.0), 450.0);  // a s^2 / 2
}

TEST(GaziPassinoConstant, IsTheForceOfItsSource) {
  const auto constant = law("gazi_passino_constant", {{"attraction", 2.0}});
  EXPECT_NEAR(force(*constant, 150.0), 2.0 - 2.0 * 300.0 / 150.0, 1e-14);
  EXPECT_NEAR(force(*constant, 3e9), 2.0, 1e-6);
  EXPECT_DOUBLE_EQ(constant->value(300.0, 300.0), 600.0);  // a s
}

TEST(VirtualSpring, IsHookesLaw) {
  const auto spring = law("virtual_spring", {{"stiffness_per_m", 0.5}});
  EXPECT_DOUBLE_EQ(spring->value(310.0, 300.0), 25.0);
  EXPECT_DOUBLE_EQ(force(*spring, 290.0), -5.0);
  EXPECT_DOUBLE_EQ(spring->derivatives(42.0, 300.0).curvature, 0.5);
}

TEST(Physicomimetics, IsGeneralisedGravityOutsideTheBand) {
  for (const double p : {-2.0, 0.0, 0.5, 1.0, 2.0, 3.0, 5.0}) {
    const auto gravity = law("physicomimetics", {{"force", 2.0}, {"power", p}});
    for (const double r : {100.0, 290.0, 310.0, 450.0}) {
      const double size = 2.0 * std::pow(300.0 / r, p);  // G / r^p with G = 2 s^p
      EXPECT_NEAR(force(*gravity, r), r < 300.0 ? -size : size, 1e-12 * size) << "p = " << p;
    }
    EXPECT_NEAR(force(*gravity, 303.0), 0.5 * 2.0 * std::pow(300.0 / 303.0, p), 1e-9);
  }
}

TEST(Physicomimetics, HasTheIntegralOfItsForceAsPotential) {
  for (const double p : {-2.0, 0.0, 1.0, 1.0 + 1e-12, 1.0 - 1e-5, 2.0, 2.0 + 1e-9, 3.5}) {
    const auto gravity = law("physicomimetics", {{"power", p}});
    EXPECT_NEAR(gravity->value(300.0, 300.0), 0.0, 1e-9);
    double sum = 0.0;  // Simpson's rule from s outwards and inwards
    for (const double end : {294.0, 306.0, 500.0}) {
      constexpr int intervals = 20'000;
      const double h = (end - 300.0) / intervals;
      sum = force(*gravity, 300.0) + force(*gravity, end);
      for (int i = 1; i < intervals; ++i) sum += (i % 2 ? 4 : 2) * force(*gravity, 300.0 + i * h);
      EXPECT_NEAR(gravity->value(end, 300.0), sum * h / 3.0, 1e-5) << "p = " << p;
    }
  }
}

TEST(Physicomimetics, TendsToThePublishedLawAsTheBandVanishes) {
  const auto gravity = law("physicomimetics", {{"band", 1e-9}});
  EXPECT_NEAR(force(*gravity, 299.9999), -1.0, 1e-6);
  EXPECT_NEAR(force(*gravity, 300.0001), 1.0, 1e-6);
  EXPECT_NEAR(gravity->value(600.0, 300.0), 150.0, 1e-5);  // s - s^2 / r
}

TEST(Physicomimetics, IsSmoothAtTheEdgesOfTheBand) {
  const auto gravity = law("physicomimetics", {{"band", 0.1}});
  for (const double edge : {270.0, 330.0}) {
    EXPECT_NEAR(gravity->value(edge - 1e-9, 300.0), gravity->value(edge + 1e-9, 300.0), 1e-8);
    EXPECT_NEAR(force(*gravity, edge - 1e-9), force(*gravity, edge + 1e-9), 1e-9);
  }
}

}  // namespace
}  // namespace shoal::formations
