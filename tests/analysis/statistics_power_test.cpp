#include "shoal/analysis/statistics/power.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace shoal::analysis::statistics {
namespace {

TEST(Power, IsThatOfCohensExamples) {
  // Cohen 1988: p. 47, one sample of 60 with d = 0.2 at a two-sided 0.1; and p. 50, 40 pairs with
  // d_z = 8 / (16 sqrt(2 (1 - 0.6))).
  EXPECT_NEAR(paired_t_power(60, 0.2, 1.0, 0.1), 0.46, 0.01);
  EXPECT_NEAR(paired_t_power(40, 8.0, 16.0 * std::sqrt(2.0 * (1.0 - 0.6)), 0.05), 0.93, 0.01);
}

TEST(Power, IsThatOfTheManualOfGPower) {
  // Faul et al. 2007: 50 matched pairs with d_z = 0.421637.
  EXPECT_NEAR(paired_t_power(50, 0.421637, 1.0, 0.05), 0.832114, 1e-6);
}

TEST(Power, IsAlphaWithoutADifference) {
  for (const Alternative alternative :
       {Alternative::two_sided, Alternative::greater, Alternative::less}) {
    EXPECT_NEAR(paired_t_power(12, 0.0, 3.0, 0.05, alternative), 0.05, 1e-12);
  }
}

TEST(Power, IsTheShareOfSamplesInWhichTheTestRejects) {
  std::mt19937 random(1);
  std::normal_distribution<double> difference(1.5, 2.0);
  constexpr int repetitions = 20'000;
  int two_sided = 0, greater = 0;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<double> sample(8);
    for (double& x : sample) x = difference(random);
    two_sided += paired_t_test(sample).value().p_value <= 0.05 ? 1 : 0;
    greater += paired_t_test(sample, Alternative::greater).value().p_value <= 0.05 ? 1 : 0;
  }
  const auto check = [](double power, int rejections) {
    EXPECT_NEAR(rejections / static_cast<double>(repetitions), power,
                4.0 * std::sqrt(power * (1.0 - power) / repetitions));
  };
  check(paired_t_power(8, 1.5, 2.0, 0.05), two_sided);
  check(paired_t_power(8, 1.5, 2.0, 0.05, Alternative::greater), greater);
  EXPECT_NEAR(paired_t_power(8, 1.5, 2.0, 0.05, Alternative::greater),
              paired_t_power(8, -1.5, 2.0, 0.05, Alternative::less), 1e-12);
}

TEST(Replications, AreTheFewestThatHaveThePower) {
  // As the pwr package of R has it: n = 33.37.
  EXPECT_EQ(replications_for(0.5, 1.0, 0.05, 0.8), 34);
  for (const double difference : {-5.0, 0.05, 0.3, 1.0, 4.0, 60.0}) {
    for (const double power : {0.06, 0.5, 0.9, 0.999}) {
      const int n = replications_for(difference, 2.0, 0.05, power, 100'000).value();
      ASSERT_GE(n, 2);
      EXPECT_GE(paired_t_power(n, difference, 2.0, 0.05), power) << n;
      if (n > 2) {
        EXPECT_LT(paired_t_power(n - 1, difference, 2.0, 0.05), power) << n;
      }
    }
  }
}

TEST(Replications, AreNothingBeyondTheMost) {
  EXPECT_EQ(replications_for(0.5, 1.0, 0.05, 0.8, 34), 34);
  EXPECT_FALSE(replications_for(0.5, 1.0, 0.05, 0.8, 33));
  EXPECT_FALSE(replications_for(100.0, 1.0, 0.05, 0.8, 1));
  EXPECT_FALSE(replications_for(0.0, 1.0, 0.05, 0.8));
}

TEST(Power, RefusesWhatIsNoQuestion) {
  EXPECT_THROW(paired_t_power(1, 1.0, 1.0, 0.05), std::invalid_argument);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(paired_t_power(9, 1.0, bad, 0.05), std::invalid_argument);
    EXPECT_THROW(paired_t_power(9, 1.0, 1.0, bad), std::invalid_argument);
    EXPECT_THROW(replications_for(1.0, 1.0, 0.05, bad), std::invalid_argument);
    EXPECT_THROW(replications_for(1.0, bad, 0.05, 0.8), std::invalid_argument);
  }
  EXPECT_THROW(paired_t_power(9, std::nan(""), 1.0, 0.05), std::invalid_argument);
  EXPECT_THROW(paired_t_power(9, 1.0, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(replications_for(1.0, 1.0, 0.05, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis::statistics
