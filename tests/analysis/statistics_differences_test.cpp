#include "shoal/analysis/statistics/differences.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/effect_size.hpp"
#include "shoal/analysis/statistics/equivalence.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/analysis/statistics/signed_ranks.hpp"

namespace shoal::analysis::statistics {
namespace {

using enum Alternative;

/// Twenty trials of seven vehicles: how many arrived with a wall to the north, and to the south.
const std::vector<int> counts_before{7, 7, 7, 7, 6, 7, 7, 6, 7, 7, 7, 6, 7, 7, 7, 7, 7, 6, 7, 7};
const std::vector<int> counts_after{5, 4, 6, 3, 7, 5, 1, 7, 6, 6, 4, 7, 7, 6, 6, 7, 2, 7, 3, 3};

struct Pairs {
  std::vector<double> before, after;
  Differences differences() const { return Differences::between(after, before); }
};

/// The counts, each as `of` makes it a number.
template <class Of>
Pairs pairs(const Of& of) {
  Pairs made;
  for (std::size_t k = 0; k < counts_before.size(); ++k) {
    made.before.push_back(of(counts_before[k]));
    made.after.push_back(of(counts_after[k]));
  }
  return made;
}

TEST(Differences, OfSharesAreTestedAsThoseOfTheCountsTheyComeFrom) {
  const Differences counts = pairs([](int k) { return k; }).differences();
  const Differences shares = pairs([](int k) { return 1.0 - k / 7.0; }).differences();
  const Differences far_off = pairs([](int k) { return 1e6 + k / 7.0; }).differences();
  EXPECT_NEAR(signed_rank_test(shares)->p_value, 0.0025024, 5e-8);
  EXPECT_NEAR(*rank_biserial_correlation(shares), 0.7661, 5e-5);
  for (const Differences* some : {&shares, &far_off}) {
    EXPECT_EQ(signed_ranks(*some).size(), signed_ranks(counts).size()) << "zeros are zeros";
    EXPECT_EQ(signed_rank_test(*some)->p_value, signed_rank_test(counts)->p_value);
    EXPECT_EQ(sign_flip_test(*some)->p_value, sign_flip_test(counts)->p_value);
    EXPECT_EQ(std::abs(*rank_biserial_correlation(*some)),
              std::abs(*rank_biserial_correlation(counts)));
  }
}

TEST(Differences, OfAnyRatiosAreTestedAsThoseOfTheirCounts) {
  EXPECT_TRUE(rc::check("ratios", [] {
    const int whole = *rc::gen::inRange(2, 60);
    const double offset = *rc::gen::element(0.0, 1.0, -3.0, 1e4);
    const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 13));
    const auto count = rc::gen::inRange(0, whole + 1);
    std::vector<double> a, b, ratio_a, ratio_b;
    for (std::size_t k = 0; k < n; ++k) {
      a.push_back(*count);
      b.push_back(*count);
      ratio_a.push_back(offset + a[k] / whole);
      ratio_b.push_back(offset + b[k] / whole);
    }
    const auto counts = Differences::between(a, b), ratios = Differences::between(ratio_a, ratio_b);
    RC_ASSERT(counts.all_zero() == ratios.all_zero());
    RC_ASSERT(rank_biserial_correlation(counts) == rank_biserial_correlation(ratios));
    for (const Alternative alternative : {two_sided, greater, less}) {
      const auto p = [&](const Differences& d) { return sign_flip_test(d, alternative)->p_value; };
      RC_ASSERT(p(counts) == p(ratios));
      const auto wilcoxon = signed_rank_test(counts, alternative);
      if (!wilcoxon) continue;
      RC_ASSERT(wilcoxon->p_value == signed_rank_test(ratios, alternative)->p_value);
    }
  }));
}

TEST(Differences, ThatScatterByRoundingOnlyDoNotScatter) {
  std::vector<double> ours, theirs;
  for (int k = 0; k < 10; ++k) {
    theirs.push_back(14.0 + 0.1 * k);
    ours.push_back(theirs.back() + 0.1);
  }
  const Differences steady = Differences::between(ours, theirs);
  EXPECT_FALSE(steady.standard_error());
  EXPECT_FALSE(paired_t_test(steady));
  EXPECT_FALSE(hedges_g_z(steady));
  EXPECT_FALSE(equivalence_p_value(steady, 1.0));
  EXPECT_EQ(sign_flip_test(steady)->p_value, std::ldexp(1.0, -9));
  EXPECT_FALSE(steady.all_zero());
}

TEST(Differences, ThatAreSmallButRealAreNotTies) {
  // A millionth of what they are differences of is far more than its rounding.
  const Differences some = Differences::between(std::vector{1.0 + 1e-6, 1.0 + 2e-6, 1.0 - 3e-6},
                                                std::vector{1.0, 1.0, 1.0});
  EXPECT_EQ(signed_ranks(some).size(), 3u);
  EXPECT_NEAR(*rank_biserial_correlation(some), 0.0, 1e-15);
  EXPECT_TRUE(paired_t_test(some));
}

TEST(Differences, OfExtremeNumbersHaveAnswers) {
  const double huge = std::numeric_limits<double>::max() / 4.0;
  for (const double unit : {huge, 1e-300}) {
    const Differences some(std::vector{unit, 2.0 * unit, 3.0 * unit, 2.0 * unit});
    const Differences plain(std::vector{1.0, 2.0, 3.0, 2.0});
    EXPECT_EQ(sign_flip_test(some)->p_value, 0.125) << unit;
    EXPECT_EQ(signed_rank_test(some)->p_value, 0.125) << unit;
    ASSERT_TRUE(paired_t_test(some)) << unit;
    EXPECT_NEAR(paired_t_test(some)->p_value, paired_t_test(plain)->p_value, 1e-12) << unit;
  }
}

TEST(Differences, NeedPairsOfFiniteNumbers) {
  const std::vector one{1.0}, two{1.0, 2.0}, bad{std::nan("")};
  EXPECT_THROW(Differences::between(one, two), std::invalid_argument);
  EXPECT_THROW(Differences::between(one, bad), std::invalid_argument);
  EXPECT_THROW(Differences{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis::statistics
