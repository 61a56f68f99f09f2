// Tables of attribution, from stores whose trials "gave" known functions of their factors.

#include "shoal/analysis/experiments/results/attribution_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace shoal::analysis {
namespace {

const char* const two_groups = R"(
replications = 3

[[group]]
name = "own"
scenario = "construction_square"
[[group.factor]]
name = "a"
key = "ping.period_s"
values = [10, 20]
[[group.factor]]
name = "b"
key = "ping.bearing_sd_deg"
values = [1, 5]

[[group]]
name = "other"
scenario = "construction_square"
[[group.factor]]
name = "b"
key = "ping.bearing_sd_deg"
values = [1, 5]
)";

const char* const difference = R"(
[[attribution]]
name = "shares"
group = "own"
minus = "other"
reference = { a = 20, b = 1 }
measures = ["energy_mean_wh"]
)";

std::string study_with(const std::string& attribution) {
  return two_groups + attribution;
}

class Attribution : public testing::Test {
 protected:
  /// `own` gives 100 + 10 seed + 4 [a = 10] + 8 [b = 5] + seed [both], `other` 50 + 6 [b = 5].
  Table table(const std::string& attribution, bool one_fails = false) {
    const TrialList list(read_study(scenarios::parse_toml(study_with(attribution), "study.toml")));
    Store store(folder_.path(), Store::Access::write);
    for (const ListedTrial& planned : list.all_trials()) {
      const TrialGroup& group = list.groups()[planned.group];
      const auto labels = group.labels(planned.cell);
      StoredTrial trial = planned_trial(list, planned);
      trial.program = "test";
      const double seed = planned.replication + 1.0;
      const bool b = labels.back() == "5";
      double energy = 50.0 + (b ? 6.0 : 0.0);
      if (group.name() == "own") {
        const bool a = labels.front() == "10";
        energy = 100.0 + 10.0 * seed + (a ? 4.0 : 0.0) + (b ? 8.0 : 0.0) + (a && b ? seed : 0.0);
      }
      trial.measures = {{"energy_mean_wh", energy}};
      if (one_fails && planned.group == 1 && planned.replication == 1) trial.failure = "it sank";
      store.write(trial);
    }
    const StudyResults results(list, store, {"energy_mean_wh"}, {});
    return attribution_table(list.study().attributions.front(), results);
  }

  static std::string complaint(const std::string& attribution) {
    try {
      const TrialList list(
          read_study(scenarios::parse_toml(study_with(attribution), "study.toml")));
      const StudyResults results(list, {"energy_mean_wh"}, {});
      attribution_table(list.study().attributions.front(), results);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  tests::ScratchFolder folder_;
};

double number(const Table& table, std::size_t row, std::size_t column) {
  return std::get<Estimate>(table.rows.at(row).at(column)).value;
}

TEST_F(Attribution, SubtractsTheOtherGroupAndSplitsTheInteraction) {
  const Table shares = table(difference);
  ASSERT_EQ(shares.rows.size(), 3U);
  // a: 4 + mean seed / 2; b: 8 - 6 + mean seed / 2.
  EXPECT_NEAR(number(shares, 0, 4), 5.0, 1e-12);
  EXPECT_NEAR(number(shares, 1, 4), 3.0, 1e-12);
  EXPECT_NEAR(number(shares, 2, 4), 8.0, 1e-12);
  EXPECT_NEAR(number(shares, 0, 5), 62.5, 1e-10);
  EXPECT_NEAR(number(shares, 0, 6), 4.0, 1e-12);
  EXPECT_NEAR(number(shares, 0, 7), 6.0, 1e-12);
  EXPECT_EQ(std::get<std::string>(shares.rows[0][2]), "20");
  EXPECT_EQ(std::get<std::string>(shares.rows[0][3]), "10");
  // Of seeds 1, 2, 3 the half of each: sd 0.5, t(2) = 4.30265.
  const auto& interval = std::get<Between>(std::get<Estimate>(shares.rows[0][4]).uncertainty);
  EXPECT_NEAR(interval.high - 5.0, 4.302653 * 0.5 / std::sqrt(3.0), 1e-5);
  EXPECT_NE(shares.notes.front().find("3 seeds; 70 at the reference, 78 with all changed"),
            std::string::npos)
      << shares.notes.front();
}

TEST_F(Attribution, WithoutAnotherGroupIsOfTheAnswerItself) {
  const Table shares = table(R"(
[[attribution]]
name = "shares"
group = "own"
reference = { a = 10, b = 5 }
measures = ["energy_mean_wh"]
)");
  EXPECT_NEAR(number(shares, 0, 4), -5.0, 1e-12);
  EXPECT_NEAR(number(shares, 1, 4), -9.0, 1e-12);
  EXPECT_NEAR(number(shares, 2, 4), -14.0, 1e-12);
}

TEST_F(Attribution, LeavesOutASeedWithAFailedTrial) {
  const Table shares = table(difference, true);
  EXPECT_NE(shares.notes.front().find("2 seeds, 1 left out"), std::string::npos);
  EXPECT_NEAR(number(shares, 2, 4), 8.0, 1e-12);  // seeds 1 and 3
}

TEST_F(Attribution, RefusesWhatIsNoFullFactorial) {
  const auto with = [](const std::string& line) {
    return "[[attribution]]\nname = \"shares\"\nmeasures = [\"energy_mean_wh\"]\n" + line;
  };
  const auto expect_says = [&](const std::string& line, const std::string& what) {
    const std::string said = complaint(with(line));
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  expect_says("reference = { a = 10, b = 1 }", "several groups; name one with group");
  expect_says("group = \"own\"\nreference = { a = 10 }", "names no level of the factor b");
  expect_says("group = \"own\"\nreference = { a = 10, b = 2 }", "has no level \"2\"; it has 1");
  expect_says("group = \"own\"\nreference = { a = 10, b = 1, c = 1 }", "no factor of the group");
  expect_says("group = \"other\"\nminus = \"own\"\nreference = { b = 1 }", "varies a");
  expect_says("group = \"own\"", "needs reference");
}

TEST_F(Attribution, RefusesAFactorOfThreeLevels) {
  std::string three = study_with("");
  three.replace(three.find("[10, 20]"), 8, "[10, 20, 30]");
  const TrialList list(read_study(scenarios::parse_toml(three + difference, "study.toml")));
  const StudyResults results(list, {"energy_mean_wh"}, {});
  EXPECT_THROW(attribution_table(list.study().attributions.front(), results), InputError);
}

}  // namespace
}  // namespace shoal::analysis
