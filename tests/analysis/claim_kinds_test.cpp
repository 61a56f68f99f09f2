// What each kind of test of a claim makes of chosen numbers.

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "shoal/analysis/experiments/claims/claim_text.hpp"
#include "tests/analysis/chosen_trials.hpp"

namespace shoal::analysis {
namespace {

using namespace chosen_trials;

class ClaimKinds : public ChosenTrials {};

/// Student's two-sided p of numbers against a mean.
double t_p(const std::vector<double>& x, double mean) {
  const double t = (statistics::mean(x) - mean) / *statistics::standard_error(x);
  const boost::math::students_t null(static_cast<double>(x.size()) - 1.0);
  return 2.0 * cdf(null, -std::abs(t));
}

TEST_F(ClaimKinds, AreReproducedOnlyBeyondTheSmallestEffectAndShowThePlainDifference) {
  // Rigid spends 2 Wh less, and their difference scatters.
  const auto energy = [](const Place& p) { return is_rigid(p) ? 8.0 + noise_of(p.k) : 10.0; };
  const ClaimResult met = judged_one(lower("smallest_effect = 1"), energy);
  EXPECT_EQ(met.verdict(), Verdict::reproduced);
  ASSERT_EQ(met.contrasts.size(), 1u);
  const Contrast& contrast = met.contrasts[0];
  EXPECT_NEAR(*contrast.estimate, -2.0, 1e-12);
  EXPECT_EQ(contrast.claimed, "below -1 Wh");
  EXPECT_NEAR(*contrast.p_holds, t_p(eight_noises, 1.0), 1e-12)
      << "noise against 1 Wh above its mean";
  EXPECT_NE(contrast_text(met, contrast).find("difference -2 Wh ["), std::string::npos);

  // An effect of 3 Wh is not there: the interval, from -2.3 to -1.7, falls short of it.
  const ClaimResult short_of_it = judged_one(lower("smallest_effect = 3"), energy);
  EXPECT_EQ(short_of_it.verdict(), Verdict::contradicted);
  EXPECT_EQ(short_of_it.contrasts[0].against, Against::too_small);
  EXPECT_NE(contrast_text(short_of_it, short_of_it.contrasts[0]).find("no difference that matters"),
            std::string::npos);

  EXPECT_EQ(judged_one(lower("smallest_effect = 2.1"), energy).verdict(), Verdict::undecided);
  // 15 % of the other's 10 Wh.
  const ClaimResult share = judged_one(lower("smallest_effect_percent = 15"), energy);
  EXPECT_EQ(share.verdict(), Verdict::reproduced);
  EXPECT_EQ(share.contrasts[0].claimed, "below -15 % of the other's (1.5 Wh)");
}

TEST_F(ClaimKinds, AreContradictedByTheOpposite) {
  const auto energy = [](const Place& p) { return is_rigid(p) ? 12.0 + noise_of(p.k) : 10.0; };
  const ClaimResult result = judged_one(lower("smallest_effect = 1"), energy);
  EXPECT_EQ(result.verdict(), Verdict::contradicted);
  EXPECT_EQ(result.contrasts[0].against, Against::opposite);
  EXPECT_EQ(
      judged_one("{ kind = \"higher\", higher = { " + of_rigid + than + "smallest_effect = 1 } }",
                 energy)
          .verdict(),
      Verdict::reproduced);
}

TEST_F(ClaimKinds, NeedEveryComparisonToHoldAndOneToFail) {
  // At 10 s rigid spends less, at 20 and 30 s more.
  const auto energy = [](const Place& p) {
    if (!is_rigid(p)) return 10.0;
    return (p.label("period") == "10" ? 7.0 : 13.0) + noise_of(p.k);
  };
  const ClaimResult all =
      judged_one(lower("smallest_effect = 1"), energy, "where = { settings = \"text\" }");
  ASSERT_EQ(all.contrasts.size(), 3u);
  EXPECT_EQ(all.verdict(), Verdict::contradicted);
  EXPECT_EQ(all.verdict_of(all.contrasts[0]), Verdict::reproduced);
  EXPECT_NEAR(all.p_fails, 3.0 * *all.contrasts[1].p_fails, 1e-15) << "Bonferroni";
  EXPECT_EQ(all.p_holds, *all.contrasts[1].p_holds) << "the weakest";
}

TEST_F(ClaimKinds, OfTwoReplicationsAreUndecided) {
  const auto energy = [](const Place& p) { return is_rigid(p) ? 8.0 + p.k : 10.0; };
  const ClaimResult two = judged_one(lower("smallest_effect = 1"), energy, "", 2);
  EXPECT_EQ(two.verdict(), Verdict::undecided);
  ASSERT_TRUE(two.replications_needed());
  EXPECT_GT(*two.replications_needed(), 2);
}

TEST_F(ClaimKinds, OnLikenessAreTwoOneSidedTestsSeedBySeed) {
  // Theirs differ a lot from seed to seed, ours follow: within 5 % of theirs in each.
  const auto energy = [](const Place& p) {
    const double theirs = 10.0 + 3.0 * p.k;
    return is_rigid(p) ? theirs * (1.0 + 0.02 * noise_of(p.k)) : theirs;
  };
  const std::string within = "to = { behaviour = \"pairwise_referencing\" }, within_percent = ";
  const auto similar = [&](const std::string& percent) {
    return judged_one("{ kind = \"similar\", similar = { " + of_rigid + within + percent + " } }",
                      energy);
  };
  const ClaimResult alike = similar("5");
  EXPECT_EQ(alike.verdict(), Verdict::reproduced);
  std::vector<double> above, below;  // ours - 0.95 theirs, 1.05 theirs - ours
  for (int k = 0; k < 8; ++k) {
    const double theirs = 10.0 + 3.0 * k, ours = theirs * (1.0 + 0.02 * noise_of(k));
    above.push_back(ours - 0.95 * theirs);
    below.push_back(1.05 * theirs - ours);
  }
  EXPECT_NEAR(*alike.contrasts[0].p_holds, std::max(t_p(above, 0.0), t_p(below, 0.0)), 1e-12);
  const auto apart = [](const Place& p) { return is_rigid(p) ? 12.0 + noise_of(p.k) : 10.0; };
  EXPECT_EQ(judged_one("{ kind = \"similar\", similar = { " + of_rigid + within + "5 } }", apart)
                .verdict(),
            Verdict::contradicted);
}

TEST_F(ClaimKinds, OnBoundsAreOnTheMeanOrOnEachTrial) {
  const auto energy = [](const Place& p) { return is_rigid(p) ? 10.0 + noise_of(p.k) : 50.0; };
  const auto verdict = [&](const std::string& test, int replications = 8) {
    return judged_one(
               test, energy,
               "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }",
               replications)
        .verdict();
  };
  EXPECT_EQ(verdict("{ kind = \"between\", between = { at_least = 9, at_most = 11 } }"),
            Verdict::reproduced);
  EXPECT_EQ(verdict("{ kind = \"between\", between.at_most = 9 }"), Verdict::contradicted);
  EXPECT_EQ(
      verdict("{ kind = \"each_between\", each_between = { at_least = 9.4, at_most = 10.5 } }"),
      Verdict::reproduced);
  EXPECT_EQ(verdict("{ kind = \"each_between\", each_between.at_most = 10.4 }"),
            Verdict::contradicted);
  EXPECT_EQ(verdict("{ kind = \"each_between\", each_between.at_most = 11 }", 1),
            Verdict::reproduced);
}

TEST_F(ClaimKinds, OnEachTrialNeedAllOfThem) {
  const std::string claim =
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmeasure = \"energy_mean_wh\"\n"
      "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n"
      "test = { kind = \"each_between\", each_between.at_most = 11 }";
  const Judgement judgement = judged(claim, [](const Place& p) {
    return p.k == 3 ? Measures{} : Measures{{"energy_mean_wh", 10.0}};
  });
  const JudgedClaim& part = judgement.statements[0].parts[0];
  EXPECT_EQ(part.verdict(0), Verdict::undecided);
  EXPECT_EQ(claim_lines(part, 0, judgement)[0],
            "from 10 to 10 Wh, claimed at most 11 Wh, 7 of 8 trials have a value: trials without a "
            "value may differ");
  EXPECT_EQ(judgement.family, 0) << "nothing is inferred";
  EXPECT_TRUE(verdict_note(judgement).ends_with("None of these verdicts rests on a p-value."));
}

TEST_F(ClaimKinds, OnSharesAreExact) {
  // 3 of 8 trials spend 20 Wh.
  const auto energy = [](const Place& p) { return p.k < 3 ? 20.0 : 10.0; };
  const std::string where =
      "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }";
  const ClaimResult some = judged_one(
      "{ kind = \"share\", share = { trial_at_least = 15, at_least = 0.05 } }", energy, where);
  EXPECT_EQ(*some.contrasts[0].estimate, 0.375);
  EXPECT_NEAR(some.contrasts[0].interval->low, 0.0852334, 1e-6);
  EXPECT_NEAR(some.contrasts[0].interval->high, 0.7551368, 1e-6);
  EXPECT_EQ(some.verdict(), Verdict::reproduced);
  EXPECT_EQ(judged_one("{ kind = \"share\", share = { trial_at_least = 15, at_least = 0.9 } }",
                       energy, where)
                .verdict(),
            Verdict::contradicted);
  EXPECT_EQ(judged_one("{ kind = \"share\", share = { trial_at_most = 15, at_least = 0.5 } }",
                       energy, where)
                .verdict(),
            Verdict::undecided);
}

double of_period(const Place& p, double at_10, double at_20, double at_30) {
  const std::string period = p.label("period");
  return (period == "10"   ? at_10
          : period == "20" ? at_20
                           : at_30) +
         noise_of(p.k + std::stoi(period));
}

const std::string one_behaviour =
    "where = { settings = \"text\", behaviour = \"rigid_registration\" }";

TEST_F(ClaimKinds, OnTrendsAreOnTheLineFromTheFirstToTheLastLevel) {
  const auto energy = [](const Place& p) { return of_period(p, 10.0, 14.0, 15.0); };
  const auto trend = [&](const std::string& direction, const std::string& smallest) {
    return judged_one("{ kind = \"trend\", trend = { along = \"period\", direction = \"" +
                          direction + "\", smallest_effect = " + smallest + " } }",
                      energy, one_behaviour);
  };
  const ClaimResult rises = trend("rises", "1");
  EXPECT_EQ(rises.verdict(), Verdict::reproduced);
  // The line over three levels changes by what its ends differ by; the noise of 10, 20 and 30 s is
  // that of the replications 2, 4 and 6 later, with the same mean.
  EXPECT_NEAR(*rises.contrasts[0].estimate, 5.0, 1e-12);
  EXPECT_EQ(trend("falls", "1").verdict(), Verdict::contradicted);
  EXPECT_EQ(trend("rises", "8").verdict(), Verdict::contradicted);
  EXPECT_EQ(trend("rises", "8").contrasts[0].against, Against::too_small);
}

TEST_F(ClaimKinds, OnATurnHoldIfAnInnerLevelIsBelowBothEnds) {
  const auto turns = [&](double at_10, double at_20, double at_30) {
    return judged_one(
        "{ kind = \"turns\", turns = { along = \"period\", smallest_effect = 1 } }",
        [&](const Place& p) { return of_period(p, at_10, at_20, at_30); }, one_behaviour);
  };
  const ClaimResult valley = turns(14.0, 10.0, 13.0);
  EXPECT_EQ(valley.verdict(), Verdict::reproduced);
  EXPECT_NEAR(*valley.contrasts[0].estimate, 3.0, 1e-12) << "to the nearer end";
  EXPECT_EQ(turns(10.0, 12.0, 14.0).verdict(), Verdict::contradicted);
  EXPECT_EQ(turns(14.0, 10.0, 10.0).verdict(), Verdict::contradicted);
}

TEST_F(ClaimKinds, OnTheNearBestCompareWithEveryOtherLevel) {
  const auto near_best = [&](const std::string& period) {
    return judged_one(
        "{ kind = \"near_best\", near_best = { cells = { period = " + period +
            " }, within_percent = 10 } }",
        [&](const Place& p) { return of_period(p, 20.0, 14.0, 14.2); }, one_behaviour);
  };
  EXPECT_EQ(near_best("20").verdict(), Verdict::reproduced);
  EXPECT_EQ(near_best("20").contrasts.size(), 2u);
  EXPECT_EQ(near_best("30").verdict(), Verdict::reproduced);
  EXPECT_EQ(near_best("10").verdict(), Verdict::contradicted);
}

TEST_F(ClaimKinds, OnScatterAreOnTheRatioOfStandardDeviations) {
  const auto steadier = [&](double scale) {
    return judged_one("{ kind = \"steadier\", steadier = { " + of_rigid + than +
                          "smallest_effect_percent = 20 } }",
                      [&](const Place& p) {
                        return 10.0 +
                               (is_rigid(p) ? scale : 1.0) * noise_of(p.k + (is_rigid(p) ? 0 : 3));
                      });
  };
  const ClaimResult result = steadier(0.1);
  EXPECT_EQ(result.verdict(), Verdict::reproduced);
  EXPECT_NEAR(*result.contrasts[0].estimate, 0.1, 1e-12);
  EXPECT_EQ(result.contrasts[0].claimed, "below 0.8");
  const ClaimResult opposite = steadier(10.0);
  EXPECT_EQ(opposite.verdict(), Verdict::contradicted);
  EXPECT_EQ(opposite.contrasts[0].against, Against::opposite);
}

TEST_F(ClaimKinds, OnConsistencyAreOnTheStandardDeviationInTheMean) {
  const auto consistent = [&](const std::string& percent) {
    return judged_one(
        "{ kind = \"consistent\", consistent.within_percent = " + percent + " }",
        [](const Place& p) { return 10.0 + noise_of(p.k); },
        "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }");
  };
  EXPECT_EQ(consistent("10").verdict(), Verdict::reproduced);
  EXPECT_NEAR(*consistent("10").contrasts[0].estimate,
              10.0 * statistics::standard_deviation(eight_noises), 1e-9);
  EXPECT_EQ(consistent("1").verdict(), Verdict::contradicted);
  EXPECT_EQ(consistent("4").verdict(), Verdict::undecided);
}

TEST_F(ClaimKinds, OnMediansAreSignTests) {
  // One trial of eight is far out; the mean says nothing.
  const auto energy = [](const Place& p) {
    return is_rigid(p) ? (p.k == 0 ? 100.0 : 8.0 + noise_of(p.k)) : 10.0;
  };
  const std::string where = "where = { settings = \"text\", period = 10 }\n";
  EXPECT_EQ(judged_one(lower("smallest_effect = 1"), energy, where).verdict(), Verdict::undecided);
  const ClaimResult median =
      judged_one(lower("smallest_effect = 1"), energy, where + "statistic = \"median\"");
  EXPECT_NEAR(*median.contrasts[0].p_holds, 2.0 * 9.0 / 256.0, 1e-12) << "7 or 8 of 8";
  EXPECT_NEAR(median.contrasts[0].interval->low, -2.6, 1e-12) << "the least";
  EXPECT_NEAR(median.contrasts[0].interval->high, 90.0, 1e-12) << "the greatest";
}

TEST_F(ClaimKinds, CompareGroupsSeedBySeed) {
  const auto energy = [](const Place& p) {
    return (p.group == "calm" ? 8.0 : 10.0) + noise_of(p.k + (p.group == "calm"));
  };
  const Judgement judgement = judged(
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\", \"rough\"]\nmeasure = \"energy_mean_wh\"\n"
      "where = { settings = \"text\", period = 10 }\n"
      "test = { kind = \"lower\", lower = { cells = { group = \"calm\" }, than = { group = "
      "\"rough\" }, smallest_effect = 0.5 } }",
      [&](const Place& p) {
        return Measures{{"energy_mean_wh", energy(p)}};
      });
  const ClaimResult& result = judgement.statements[0].parts[0].columns[0]->result;
  ASSERT_EQ(result.contrasts.size(), 2u) << "one a behaviour";
  EXPECT_NEAR(*result.contrasts[0].estimate, -2.0, 1e-12);
  EXPECT_EQ(result.contrasts[0].title, "rigid_registration: group = calm - group = rough");
  EXPECT_EQ(result.verdict(), Verdict::reproduced);
}

TEST_F(ClaimKinds, OnSeriesMayBeOnAChangeAndOnADifferenceOfTwo) {
  const std::vector<scenarios::Series> series{
      {"energy_mean_wh", "", "", {0.0, 100.0, 200.0}, {1.0, 2.0, 7.0}},
      {"energy_max_wh", "", "", {0.0, 100.0, 200.0}, {2.0, 5.0, 6.0}}};
  const auto estimate = [&](const std::string& number) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nseries = \"energy_mean_wh\"\n" + number +
            "\nwhere = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n"
            "test = { kind = \"between\", between.at_least = 0 }",
        [](const Place&) {
          return Measures{{"energy_mean_wh", 0.0}};
        },
        8, series);
    return *judgement.statements[0].parts[0].columns[0]->result.contrasts[0].estimate;
  };
  EXPECT_EQ(estimate("at_s = 150"), 4.5);
  EXPECT_EQ(estimate("at_s = 200\nsince_s = 100"), 5.0);
  EXPECT_EQ(estimate("at_s = 200\nsince_s = 100\nminus = \"energy_max_wh\""), 4.0) << "1 less -3";
}

TEST_F(ClaimKinds, OnTimesCountTrialsThatNeverGotThereWithTheirBound) {
  const Judgement judgement = judged(
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmeasure = \"time_to_quality_20m_s\"\n"
      "where = { settings = \"text\", period = 10 }\ntest = " +
          lower("smallest_effect = 60"),
      [](const Place& p) {
        const std::optional<double> reached =
            is_rigid(p) && p.k < 2
                ? std::nullopt
                : std::optional(600.0 + p.k + (is_rigid(p) ? 0.0 : noise_of(p.k)));
        return Measures{{"time_to_quality_20m_s", reached}, {"quality_watched_s", 3600.0}};
      });
  const JudgedClaim& part = judgement.statements[0].parts[0];
  const Contrast& contrast = part.columns[0]->result.contrasts[0];
  EXPECT_EQ(contrast.n, 8);
  EXPECT_EQ(contrast.never_reached, 2);
  EXPECT_NEAR(*contrast.estimate,
              (3000.0 + 2999.0 - 0.3 + 0.2 - 0.5 + 0.4 - 0.1 + 0.6 - 0.2 - 0.1) / 8.0, 1e-9);
  EXPECT_NE(claim_lines(part, 0, judgement)[0].find(
                "n = 8, 2 of them without the event, taken at the end of their watch"),
            std::string::npos);
}

}  // namespace
}  // namespace shoal::analysis
