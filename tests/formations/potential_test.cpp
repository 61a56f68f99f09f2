#include "shoal/formations/potential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

constexpr double separations[] = {0.5, 30.0, 300.0};

/// Every enrolled potential with its defaults: a new one is tested by being there.
class EnrolledPotential : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Potential> potential =
      Registry<Potential>::instance().make(GetParam(), Setting{}, "test");
};

TEST_P(EnrolledPotential, HasTheDerivativesOfItsValue) {
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
      EXPECT_EQ(exact.value, f(r));
      EXPECT_NEAR(exact.slope, slope, 1e-10 * size / r) << "r = " << r << ", s = " << s;
      EXPECT_NEAR(exact.curvature, curvature, 1e-6 * size / (r * r))
          << "r = " << r << ", s = " << s;
    }
  }
}

TEST_P(EnrolledPotential, IsLowestAtTheSeparation) {
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

TEST_P(EnrolledPotential, PushesOutwardsInsideAndInwardsOutside) {
  for (const double s : separations) {
    for (int i = 10; i <= 500; ++i) {
      if (i == 100) continue;
      const double slope = potential->derivatives(0.01 * i * s, s).slope;
      EXPECT_TRUE(i < 100 ? slope < 0.0 : slope > 0.0) << "r/s = " << 0.01 * i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Potentials, EnrolledPotential,
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

}  // namespace
}  // namespace shoal::formations
