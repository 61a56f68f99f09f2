#include "shoal/analysis/statistics/power.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

TEST(Power, OfAnyEffectIsANumber) {
  for (const double effect : {1e-300, 1e3, 1e13, 1e300, std::numeric_limits<double>::infinity()}) {
    for (const double alpha : {0.05, 1e-4, 1e-12}) {
      for (const int n : {2, 3, 40, 10'000}) {
        const double power = paired_t_power(n, effect, 1.0, alpha);
        EXPECT_GE(power, alpha * (1.0 - 1e-9)) << n << " " << effect;
        EXPECT_LE(power, 1.0);
        EXPECT_LE(paired_t_power(n, effect, 1.0, alpha, Alternative::less), alpha * (1.0 + 1e-9));
      }
      EXPECT_GE(paired_t_power(40, std::max(effect, 1e3), 1.0, alpha), 1.0 - 1e-12);
    }
  }
  EXPECT_EQ(replications_for(1.0, 1e-13, 0.05, 0.8), 2);
  EXPECT_EQ(replications_for(1.0, std::numeric_limits<double>::denorm_min(), 0.05, 0.8), 2);
}

TEST(Power, OfTwoPairsIsThatOfTheCauchyDistributionWithoutAnEffect) {
  EXPECT_NEAR(paired_t_power(2, 0.0, 1.0, 1e-6), 1e-6, 1e-15);
}

using SharedTest = std::shared_ptr<const PairedTest>;

const SharedTest sign_flip = Choice<PairedTest>("sign_flip").make();
const SharedTest wilcoxon = Choice<PairedTest>("wilcoxon").make();
const SharedTest paired_t = Choice<PairedTest>("paired_t").make();

TEST(LeastPValue, IsWhatTheTestGivesWhenAllDifferencesAgree) {
  for (const int n : {1, 5, 20, 32}) {
    std::vector<double> agreeing;
    for (int i = 1; i <= n; ++i) agreeing.push_back(i);
    EXPECT_EQ(sign_flip_test(agreeing)->p_value, sign_flip->least_p_value(n));
    EXPECT_NEAR(signed_rank_test(agreeing)->p_value, wilcoxon->least_p_value(n), 1e-15);
  }
  EXPECT_EQ(paired_t->least_p_value(5), 0.0);
  EXPECT_EQ(sign_flip_test(std::vector<double>(40, 1.0))->p_value, sign_flip->least_p_value(40));
}

TEST(PowerOfExactTests, IsTheShareOfSamplesInWhichTheyReject) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  struct Case {
    SharedTest test;
    int n;
    double effect, alpha;
  };
  // Few patterns of signs, where the power is simulated, and many, where it is the t test's.
  for (const Case& each : {Case{sign_flip, 6, 1.5, 0.05}, Case{sign_flip, 9, 1.0, 0.05},
                           Case{sign_flip, 16, 0.8, 0.05}, Case{wilcoxon, 7, 1.5, 0.05},
                           Case{wilcoxon, 12, 0.9, 0.01}, Case{wilcoxon, 70, 0.35, 0.05}}) {
    constexpr int repetitions = 4000;
    int rejected = 0;
    for (int i = 0; i < repetitions; ++i) {
      std::vector<double> sample(static_cast<std::size_t>(each.n));
      for (double& x : sample) x = each.effect + normal(random);
      const auto result =
          each.test == sign_flip ? sign_flip_test(sample) : signed_rank_test(sample);
      rejected += result->p_value <= each.alpha ? 1 : 0;
    }
    const double power = two_sided_power(*each.test, each.n, each.effect, each.alpha);
    // Both are shares of 4000 samples; formulas may be off by a hundredth.
    const double error = std::sqrt(2.0 * power * (1.0 - power) / repetitions);
    EXPECT_NEAR(rejected / static_cast<double>(repetitions), power, 4.0 * error + 0.01)
        << each.n << " " << each.effect;
  }
}

TEST(PowerOfExactTests, IsNoneBelowTheirFloor) {
  EXPECT_EQ(two_sided_power(*sign_flip, 5, 100.0, 0.05), 0.0);  // 2 / 32
  EXPECT_EQ(two_sided_power(*sign_flip, 6, 100.0, 0.05), 1.0);  // 2 / 64
  EXPECT_EQ(two_sided_power(*wilcoxon, 5, 100.0, 0.05), 0.0);
  EXPECT_EQ(two_sided_power(*wilcoxon, 6, 100.0, 0.05), 1.0);
}

TEST(Replications, OfExactTestsAreNeverFewerThanTheirFloorAsks) {
  const double never_scatters = std::numeric_limits<double>::infinity();
  EXPECT_EQ(replications_for(*paired_t, never_scatters, 0.05, 0.8), 2);
  EXPECT_EQ(replications_for(*sign_flip, never_scatters, 0.05, 0.8), 6);
  EXPECT_EQ(replications_for(*wilcoxon, never_scatters, 0.05, 0.8), 6);
  EXPECT_EQ(replications_for(*sign_flip, never_scatters, 0.05 / 48.0, 0.8), 11);  // 48 rows, Holm
  for (const double effect : {0.4, 0.8, 1.6, 5.0}) {
    const int t = replications_for(*paired_t, effect, 0.05, 0.8).value();
    for (const SharedTest& test : {sign_flip, wilcoxon}) {
      const int n = replications_for(*test, effect, 0.05, 0.8).value();
      EXPECT_GE(n, std::max(t, 6)) << effect;
      EXPECT_LE(n, std::max(6.0, 1.1 * t + 3.0)) << effect;
      EXPECT_GE(two_sided_power(*test, n, effect, 0.05), 0.8) << effect;
    }
  }
  EXPECT_FALSE(replications_for(*sign_flip, 0.0, 0.05, 0.8, 100));
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
