// Claims on studies whose trials "gave" chosen numbers.

#include <gtest/gtest.h>
#include <unistd.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <filesystem>
#include <functional>

#include "shoal/analysis/study/claim_text.hpp"
#include "shoal/analysis/study/claim_verdicts.hpp"
#include "shoal/analysis/study/study_tables.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/core/settings.hpp"

namespace shoal::analysis {
namespace {

using tests::complaint_of;
using Metrics = std::vector<std::pair<std::string, std::optional<double>>>;
namespace fs = std::filesystem;

/// Where a trial stands: `label("behaviour")`, and its replication from 0.
struct Place {
  std::string group;
  std::vector<std::string> names, labels;
  int k;
  std::string label(const std::string& name) const {
    return labels[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())];
  }
};
using Gave = std::function<Metrics(const Place&)>;

const char* const factors_of_a_group = R"(
[[group.factor]]
name = "settings"
levels_of_settings
[[group.factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing"]
[[group.factor]]
name = "period"
key = "ping.period_s"
values = [10, 20, 30]
)";

std::string study_text(int replications) {
  std::string of_group = factors_of_a_group;
  const std::string word = "levels_of_settings";
  of_group.replace(of_group.find(word), word.size(),
                   "[[group.factor.level]]\nlabel = \"text\"\n[[group.factor.level]]\nlabel = "
                   "\"program\"\nset = { ping.bearing_sd_deg = 1 }");
  std::string text =
      "replications = " + std::to_string(replications) + "\nclaims = \"claims.toml\"\n";
  for (const std::string name : {"calm", "rough"}) {
    text += "[[group]]\nname = \"" + name + "\"\nscenario = \"construction_square\"\n" + of_group;
  }
  return text;
}

class Claims : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("shoal_claims_" + std::to_string(::getpid())) / "study";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  /// The claims of a file on a study whose trials gave these metrics; a trial without any failed.
  Judgement judged(const std::string& claims, const Gave& gave, int replications = 8,
                   const std::vector<scenarios::Series>& series = {}) {
    write_whole_file(folder_ / "claims.toml", claims);
    write_whole_file(folder_ / "study.toml", study_text(replications));
    const StudyPlan plan(read_study(scenarios::read_toml(folder_ / "study.toml")));
    require_answerable(plan);
    Store store(folder_, Store::Access::write);
    store.together([&] {
      for (const PlannedTrial& planned : plan.all_trials()) {
        const PlannedGroup& group = plan.groups()[planned.group];
        const auto labels = group.labels(planned.cell);
        StoredTrial trial;
        trial.key = group.key(planned.cell, planned.replication);
        trial.program = "test";
        trial.metrics = gave(
            {group.name(), group.columns(), {labels.begin(), labels.end()}, planned.replication});
        if (trial.metrics.empty()) trial.failure = "it sank";
        trial.series = series;
        store.write(trial);
      }
    });
    return judged_claims(read_results(plan, folder_), folder_);
  }

  /// The one claim on energies, in the group `calm` under the settings of the text.
  ClaimResult judged_one(const std::string& test, const std::function<double(const Place&)>& energy,
                         const std::string& more = "", int replications = 8) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\nmetric = \"energy_mean_wh\"\ngroups = [\"calm\"]\n" +
            (more.empty() ? std::string("where = { settings = \"text\", period = 10 }") : more) +
            "\ntest = " + test,
        [&](const Place& place) {
          return Metrics{{"energy_mean_wh", energy(place)}};
        },
        replications);
    return judgement.statements.front().parts.front().columns.front()->result;
  }

  fs::path folder_;
};

const std::vector<double> eight_noises{0.3, -0.2, 0.5, -0.4, 0.1, -0.6, 0.2, 0.1};

double noise_of(int k) {
  return eight_noises[static_cast<std::size_t>(k) % eight_noises.size()];
}

bool is_rigid(const Place& place) {
  return place.label("behaviour") == "rigid_registration";
}

const std::string of_rigid = "cells = { behaviour = \"rigid_registration\" }, ";
const std::string than = "than = { behaviour = \"pairwise_referencing\" }, ";

std::string lower(const std::string& smallest) {
  return "{ kind = \"lower\", lower = { " + of_rigid + than + smallest + " } }";
}

/// Student's two-sided p of numbers against a mean.
double t_p(const std::vector<double>& x, double mean) {
  const double t = (statistics::mean(x) - mean) / *statistics::standard_error(x);
  const boost::math::students_t null(static_cast<double>(x.size()) - 1.0);
  return 2.0 * cdf(null, -std::abs(t));
}

TEST_F(Claims, AreReproducedOnlyBeyondTheSmallestEffectAndShowThePlainDifference) {
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

TEST_F(Claims, AreContradictedByTheOpposite) {
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

TEST_F(Claims, NeedEveryComparisonToHoldAndOneToFail) {
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

TEST_F(Claims, OfTwoReplicationsAreUndecided) {
  const auto energy = [](const Place& p) { return is_rigid(p) ? 8.0 + p.k : 10.0; };
  const ClaimResult two = judged_one(lower("smallest_effect = 1"), energy, "", 2);
  EXPECT_EQ(two.verdict(), Verdict::undecided);
  ASSERT_TRUE(two.replications_needed());
  EXPECT_GT(*two.replications_needed(), 2);
}

TEST_F(Claims, OnLikenessAreTwoOneSidedTestsSeedBySeed) {
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

TEST_F(Claims, OnBoundsAreOnTheMeanOrOnEachTrial) {
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

TEST_F(Claims, OnEachTrialNeedAllOfThem) {
  const std::string claim =
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmetric = \"energy_mean_wh\"\n"
      "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n"
      "test = { kind = \"each_between\", each_between.at_most = 11 }";
  const Judgement judgement = judged(claim, [](const Place& p) {
    return p.k == 3 ? Metrics{} : Metrics{{"energy_mean_wh", 10.0}};
  });
  const JudgedClaim& part = judgement.statements[0].parts[0];
  EXPECT_EQ(part.verdict(0), Verdict::undecided);
  EXPECT_EQ(claim_lines(part, 0, judgement)[0],
            "from 10 to 10 Wh, claimed at most 11 Wh, 7 of 8 trials have a value: trials without a "
            "value may differ");
  EXPECT_EQ(judgement.family, 0) << "nothing is inferred";
  EXPECT_TRUE(verdict_note(judgement).ends_with("None of these verdicts rests on a p-value."));
}

TEST_F(Claims, OnSharesAreExact) {
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

TEST_F(Claims, OnTrendsAreOnTheLineFromTheFirstToTheLastLevel) {
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

TEST_F(Claims, OnATurnHoldIfAnInnerLevelIsBelowBothEnds) {
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

TEST_F(Claims, OnTheNearBestCompareWithEveryOtherLevel) {
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

TEST_F(Claims, OnScatterAreOnTheRatioOfStandardDeviations) {
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

TEST_F(Claims, OnConsistencyAreOnTheStandardDeviationInTheMean) {
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

TEST_F(Claims, OnMediansAreSignTests) {
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

TEST_F(Claims, CompareGroupsSeedBySeed) {
  const auto energy = [](const Place& p) {
    return (p.group == "calm" ? 8.0 : 10.0) + noise_of(p.k + (p.group == "calm"));
  };
  const Judgement judgement = judged(
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\", \"rough\"]\nmetric = \"energy_mean_wh\"\n"
      "where = { settings = \"text\", period = 10 }\n"
      "test = { kind = \"lower\", lower = { cells = { group = \"calm\" }, than = { group = "
      "\"rough\" }, smallest_effect = 0.5 } }",
      [&](const Place& p) {
        return Metrics{{"energy_mean_wh", energy(p)}};
      });
  const ClaimResult& result = judgement.statements[0].parts[0].columns[0]->result;
  ASSERT_EQ(result.contrasts.size(), 2u) << "one a behaviour";
  EXPECT_NEAR(*result.contrasts[0].estimate, -2.0, 1e-12);
  EXPECT_EQ(result.contrasts[0].title, "rigid_registration: group = calm - group = rough");
  EXPECT_EQ(result.verdict(), Verdict::reproduced);
}

TEST_F(Claims, OnSeriesMayBeOnAChangeAndOnADifferenceOfTwo) {
  const std::vector<scenarios::Series> series{
      {"energy_mean_wh", "", "", {0.0, 100.0, 200.0}, {1.0, 2.0, 7.0}},
      {"energy_max_wh", "", "", {0.0, 100.0, 200.0}, {2.0, 5.0, 6.0}}};
  const auto estimate = [&](const std::string& number) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nseries = \"energy_mean_wh\"\n" + number +
            "\nwhere = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n"
            "test = { kind = \"between\", between.at_least = 0 }",
        [](const Place&) {
          return Metrics{{"energy_mean_wh", 0.0}};
        },
        8, series);
    return *judgement.statements[0].parts[0].columns[0]->result.contrasts[0].estimate;
  };
  EXPECT_EQ(estimate("at_s = 150"), 4.5);
  EXPECT_EQ(estimate("at_s = 200\nsince_s = 100"), 5.0);
  EXPECT_EQ(estimate("at_s = 200\nsince_s = 100\nminus = \"energy_max_wh\""), 4.0) << "1 less -3";
}

TEST_F(Claims, OnTimesCountTrialsThatNeverGotThereWithTheirBound) {
  const Judgement judgement = judged(
      "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmetric = \"time_to_quality_20m_s\"\n"
      "where = { settings = \"text\", period = 10 }\ntest = " +
          lower("smallest_effect = 60"),
      [](const Place& p) {
        const std::optional<double> reached =
            is_rigid(p) && p.k < 2
                ? std::nullopt
                : std::optional(600.0 + p.k + (is_rigid(p) ? 0.0 : noise_of(p.k)));
        return Metrics{{"time_to_quality_20m_s", reached}, {"quality_watched_s", 3600.0}};
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

TEST_F(Claims, HaveOneVerdictAStatementAndColumnCorrectedOverAll) {
  const std::string in_calm =
      "groups = [\"calm\"]\nwhere = { period = 10 }\nmetric = \"energy_mean_wh\"\n";
  const auto file = [&](const std::string& correction) {
    return "correction = \"" + correction +
           "\"\nside_by_side = \"settings\"\n"
           "[[statement]]\nnumber = 2\nsays = \"both\"\nsection = \"1.2\"\n"
           "[[statement]]\nnumber = 1\nsays = \"never\"\nnot_tested = \"no measure of it\"\n"
           "[[claim]]\nstatement = 2\nsays = \"less\"\n" +
           in_calm + "test = " + lower("smallest_effect = 1") +
           "\n[[claim]]\nstatement = 2\nsays = \"at most 11 Wh\"\n" + in_calm +
           "test = { kind = \"between\", between.at_most = 11 }\n"
           "[[claim]]\nsays = \"alone\"\n" +
           in_calm + "test = { kind = \"between\", between.at_most = 9.99 }\n";
  };
  // Under `text` rigid spends less than pairwise, under `program` more.
  const Gave gave = [](const Place& p) {
    const double rigid_wh = p.label("settings") == "text" ? 8.0 : 12.0;
    return Metrics{
        {"energy_mean_wh", (is_rigid(p) ? rigid_wh : 10.0) + noise_of(p.k + is_rigid(p))}};
  };
  const Judgement judgement = judged(file("holm"), gave);
  EXPECT_EQ(judgement.columns, (std::vector<std::string>{"text", "program"}));
  ASSERT_EQ(judgement.statements.size(), 3u);
  const JudgedStatement& untested = judgement.statements[0];
  EXPECT_EQ(untested.verdict_text(0), "not tested");
  const JudgedStatement& both = judgement.statements[1];
  ASSERT_EQ(both.parts.size(), 2u);
  EXPECT_EQ(both.verdict_text(0), "reproduced");
  EXPECT_EQ(both.verdict_text(1), "contradicted");
  EXPECT_EQ(judgement.family, 6) << "three claims in two columns";
  EXPECT_EQ(count_lines(judgement)[0],
            "text: 3 statements: 1 reproduced, 0 contradicted, 1 undecided, 1 not tested");

  // Holm by hand: p-values in order times 6, 5, 4 ..., each at least the one before.
  std::vector<std::pair<double, double>> p;  // as it is, corrected
  for (const JudgedStatement& statement : judgement.statements) {
    for (const JudgedClaim& part : statement.parts) {
      for (const auto& column : part.columns) {
        p.emplace_back(std::min({1.0, column->result.p_holds, column->result.p_fails}),
                       column->corrected_p);
      }
    }
  }
  std::ranges::sort(p);
  double before = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    before = std::min(1.0, std::max(before, p[i].first * static_cast<double>(6 - i)));
    EXPECT_NEAR(p[i].second, before, 1e-12);
  }
  EXPECT_EQ(judged(file("none"), gave).statements[1].parts[0].columns[0]->result.correction, 1.0);
  const Table table = claims_table(judgement);
  ASSERT_EQ(table.rows.size(), 5u) << "three statements, and the two parts of one";
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_FALSE(print(table, TableFormat::latex).empty());
}

TEST_F(Claims, ThatTheCorrectionLeavesUndecidedSaySo) {
  std::string file;
  for (int i = 0; i < 30; ++i) {
    file +=
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmetric = \"energy_mean_wh\"\nwhere = { "
        "settings = "
        "\"text\", period = 10, behaviour = \"rigid_registration\" }\n"
        "test = { kind = \"between\", between.at_most = 10.35 }\n";
  }
  const Judgement judgement = judged(file, [](const Place& p) {
    return Metrics{{"energy_mean_wh", 10.0 + noise_of(p.k)}};
  });
  const JudgedColumn& column = *judgement.statements[0].parts[0].columns[0];
  EXPECT_LT(column.result.p_holds, 0.05);
  EXPECT_TRUE(column.result.corrected_away());
  EXPECT_NEAR(column.corrected_p, std::min(1.0, 30.0 * column.result.p_holds), 1e-12);
  EXPECT_NE(contrast_text(column.result, column.result.contrasts[0])
                .find("decided only without the correction"),
            std::string::npos);
  EXPECT_GT(*column.result.replications_needed(), 8);
}

TEST_F(Claims, NameACauseOnlyIfItsOwnTestHolds) {
  const auto lines = [&](const std::string& cause) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmetric = \"energy_mean_wh\"\n"
        "where = { settings = \"text\", period = 10 }\ntest = " +
            lower("smallest_effect = 1") +
            "\n[claim.cause]\nsays = \"it fragments\"\nmetric = \"fragments\"\n"
            "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n" +
            cause,
        [](const Place& p) {
          return Metrics{
              {"energy_mean_wh", (is_rigid(p) ? 12.0 : 10.0) + noise_of(p.k + is_rigid(p))},
              {"fragments", 3.0 + noise_of(p.k)}};
        });
    return claim_lines(judgement.statements[0].parts[0], 0, judgement);
  };
  const auto held = lines("test = { kind = \"between\", between.at_least = 2 }");
  EXPECT_EQ(held[held.size() - 2], "cause: it fragments");
  EXPECT_EQ(held.back().substr(0, 6), "  3 [2");
  EXPECT_EQ(lines("test = { kind = \"between\", between.at_least = 4 }").back(),
            "no cause established");
  EXPECT_EQ(lines("test = { kind = \"between\", between.at_least = 2 }\nstudy = \"other\"").back(),
            "run shoal sweep other to see the cause");
  // The study itself, stored beside, as the other one.
  EXPECT_EQ(lines("groups = [\"calm\"]\ntest = { kind = \"between\", between.at_least = 2 }\nstudy "
                  "= \"study\"")
                .back(),
            held.back());
}

TEST_F(Claims, ThatAreNotWrittenRightAreRefusedByLine) {
  const auto complaint = [&](const std::string& claim) {
    return complaint_of([&] {
      read_claims(scenarios::parse_toml("[[claim]]\nsays = \"so\"\n" + claim, "claims.toml"));
    });
  };
  EXPECT_EQ(
      complaint("metric = \"fragments\"\ncause = \"the sea\"\ntest = { kind = \"between\", "
                "between.at_most = 1 }"),
      "claims.toml:4: a cause is not a text but a statement with a test of its own: write "
      "[claim.cause] with says, metric and test (and study, if other trials show it), or leave "
      "it out");
  EXPECT_NE(complaint("metric = \"fragments\"\ntest = " + lower("smallest_effect = 0"))
                .find("needs smallest_effect or smallest_effect_percent, above 0"),
            std::string::npos);
  EXPECT_NE(complaint("metric = \"fragments\"\ntest = " +
                      lower("smallest_effect = 1, smallest_effect_percent = 1"))
                .find("not both"),
            std::string::npos);
  EXPECT_NE(
      complaint(
          "metric = \"fragments\"\nat_s = 3\ntest = { kind = \"between\", between.at_most = 1 }")
          .find("at_s and since_s belong to a series"),
      std::string::npos);
  const std::string of_3 =
      "statement = 3\nmetric = \"fragments\"\ntest = { kind = \"between\", between.at_most = 1 }\n";
  EXPECT_EQ(complaint(of_3), "");
  EXPECT_NE(
      complaint(of_3 + "[[claim]]\nsays = \"more\"\n" + of_3).find("statement 3 has several parts"),
      std::string::npos);
  EXPECT_NE(complaint(of_3 + "[[statement]]\nnumber = 4\nsays = \"none\"\n")
                .find("statement 4 has no [[claim]]"),
            std::string::npos);
}

TEST_F(Claims, OnWhatTheStudyLacksAreRefused) {
  const auto complaint = [&](const std::string& more) {
    return complaint_of([&] {
      judged(
          "side_by_side = \"settings\"\n[[claim]]\nsays = \"so\"\nmetric = \"energy_mean_wh\"\n" +
              more + "\ntest = " + lower("smallest_effect = 1"),
          [](const Place&) { return Metrics{}; });
    });
  };
  const std::string file = (folder_ / "claims.toml").string();
  EXPECT_EQ(complaint("groups = [\"calm\"]\nwhere = { perod = 10 }"),
            file + ":2: the group calm has no factor \"perod\"; did you mean \"period\"?");
  EXPECT_EQ(complaint("groups = [\"calm\"]\nwhere = { period = 15 }"),
            file + ":2: no cell of the study is as `where` says");
  EXPECT_EQ(complaint("where = { period = 10 }"),
            file + ":2: the study has several groups; say which the claim is about");
}

}  // namespace
}  // namespace shoal::analysis
