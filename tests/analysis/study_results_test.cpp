#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "shoal/analysis/experiments/results/cell_table.hpp"
#include "shoal/analysis/experiments/results/difference_table.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/core/settings.hpp"

namespace shoal::analysis {
namespace {

using tests::complaint_of;

const char* const two_factors = R"(
scenario = "construction_square"
replications = 5
[[factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing"]
[[factor]]
name = "period"
key = "ping.period_s"
values = [10, 20]
)";

/// A study whose trials "gave" chosen energies: behaviour, period -> by replication. A cell that is
/// not named failed.
class Stored : public testing::Test {
 protected:
  using Energies = std::map<std::pair<std::string, std::string>, std::vector<double>>;

  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("shoal_study_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  StudyResults results(const Energies& energies, const std::string& text = two_factors) {
    const TrialList list(read_study(scenarios::parse_toml(text, "study.toml")));
    Store store(folder_, Store::Access::write);
    const TrialGroup& group = list.groups().front();
    for (const ListedTrial& planned : list.all_trials()) {
      StoredTrial trial = planned_trial(list, planned);
      trial.program = "test";
      const auto labels = group.labels(planned.cell);
      const auto found = energies.find({labels[0], labels[1]});
      if (found == energies.end()) {
        trial.failure = "it sank";
      } else {
        const auto k = static_cast<std::size_t>(planned.replication);
        trial.measures = {{"energy_mean_wh", found->second.at(k)}};
      }
      store.write(trial);
    }
    return {list, store, {"energy_mean_wh"}, {}};
  }

  std::filesystem::path folder_;
};

const std::string rigid = "rigid_registration", pairwise = "pairwise_referencing";
const std::vector<double> low{10, 11, 12, 13, 14}, high{20, 21.5, 22, 23.5, 24},
    mixed{9, 12, 11, 14, 13};

TEST_F(Stored, ATableShowsNAndFailuresAndTheBestOnlyIfATestTellsIt) {
  const StudyResults all =
      results({{{rigid, "10"}, low}, {{pairwise, "10"}, high}, {{rigid, "20"}, low}});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.columns = {"period"};
  request.measures = {"energy_mean_wh"};
  request.best = Best::lowest;
  request.compare = "behaviour";
  request.test = "paired_t";
  const Table table = cell_table(request, all);
  ASSERT_EQ(table.rows.size(), 2u);
  const auto& best = std::get<Estimate>(table.rows[0][1]);
  EXPECT_EQ(best.value, 12.0);
  EXPECT_EQ(best.n, 5);
  EXPECT_TRUE(best.best);
  EXPECT_NEAR(std::get<PlusMinus>(best.uncertainty).by, 2.776445105 * std::sqrt(2.5 / 5.0), 1e-8);
  EXPECT_FALSE(std::get<Estimate>(table.rows[1][1]).best);
  EXPECT_EQ(std::get<Missing>(table.rows[1][2]).failed, 5);
  EXPECT_FALSE(std::get<Estimate>(table.rows[0][2]).best);  // nothing to compare with

  // Of five replications no sign-flip test reaches 5 % two-sided: 2 / 32.
  request.test = "sign_flip";
  EXPECT_FALSE(std::get<Estimate>(cell_table(request, all).rows[0][1]).best);
}

TEST_F(Stored, AHeaderOverSeveralMeasuresSaysWhatItsNumberIsOf) {
  const TrialList list(read_study(scenarios::parse_toml(two_factors, "study.toml")));
  const StudyResults none(list, {"energy_mean_wh", "quality_final_m"}, {});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.columns = {"period"};
  request.measures = {"energy_mean_wh", "quality_final_m"};
  const Table of_periods = cell_table(request, none);
  EXPECT_EQ(of_periods.columns[1].group, "period 10 s");
  EXPECT_EQ(of_periods.columns[4].group, "period 20 s");
  EXPECT_EQ(of_periods.columns[4].name, "20_quality_final_m");
  std::swap(request.rows, request.columns);
  EXPECT_EQ(cell_table(request, none).columns[1].group, rigid);
}

TEST_F(Stored, NotRunFailedUndefinedAndNeverReachedAreFourAnswers) {
  using enum Answer::Kind;
  const TrialList list(read_study(scenarios::parse_toml(two_factors, "study.toml")));
  Store store(folder_, Store::Access::write);
  using Measures = std::vector<std::pair<std::string, std::optional<double>>>;
  const std::vector<Measures> trials{
      {{"time_to_quality_20m_s", 600.0}, {"quality_watched_s", 3600.0}, {"path_straightness", 0.9}},
      {{"time_to_quality_20m_s", {}}, {"quality_watched_s", 3600.0}, {"path_straightness", 0.5}},
      {{"time_to_quality_20m_s", {}}, {"quality_watched_s", {}}, {"path_straightness", {}}},
      {}};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const ListedTrial& planned = list.trial(i);
    StoredTrial trial = planned_trial(list, planned);
    trial.program = "test";
    trial.measures = trials[i];
    if (trials[i].empty()) trial.failure = "it sank";
    store.write(trial);
  }
  const StudyResults all(list, store, {"time_to_quality_20m_s", "path_straightness"}, {});
  const auto answer = [&](const char* measure, std::size_t i) {
    const Answer found = all.answer({.measure = measure}, i);
    return std::pair(found.kind, found.number);
  };
  for (const std::size_t i : {0U, 1U, 2U, 3U, 4U}) {
    const Answer::Kind kinds[]{value, never_reached, undefined, failed, not_run};
    EXPECT_EQ(answer("time_to_quality_20m_s", i), std::pair(kinds[i], i == 0   ? 600.0
                                                                      : i == 1 ? 3600.0
                                                                               : 0.0));
    EXPECT_EQ(answer("path_straightness", i), std::pair(kinds[i], i == 0   ? 0.9
                                                                  : i == 1 ? 0.5
                                                                           : 0.0));
  }
  EXPECT_EQ(all.answer({.measure = "time_to_quality_20m_s"}, 1).bounded(), 3600.0);
  EXPECT_EQ(all.stored("time_to_quality_20m_s", 1), std::nullopt);
}

TEST_F(Stored, AFactorIsNotAveragedInSilence) {
  const StudyResults all = results({{{rigid, "10"}, low}, {{rigid, "20"}, high}});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.measures = {"energy_mean_wh"};
  EXPECT_NE(complaint_of([&] { cell_table(request, all); }).find("period has several levels"),
            std::string::npos);
  request.pool = {"period"};
  const Table table = cell_table(request, all);
  EXPECT_EQ(std::get<Estimate>(table.rows[0][1]).n, 10);
}

TEST_F(Stored, DifferencesAreTakenSeedBySeed) {
  const StudyResults all = results({{{rigid, "10"}, low}, {{pairwise, "10"}, mixed}});
  ComparisonRequest request;
  request.name = "d";
  request.factor = "behaviour";
  request.reference = rigid;
  request.measures = {"energy_mean_wh"};
  const Table table = difference_table(request, all);
  const auto& difference = std::get<Estimate>(table.rows[0][3]);
  EXPECT_NEAR(difference.value, -0.2, 1e-12);  // -1, 1, -1, 1, -1
  EXPECT_EQ(difference.n, 5);
  // 20 of 32 patterns of signs sum to -1 or 1, the others lie further out: all are as far out.
  EXPECT_EQ(std::get<Estimate>(table.rows[0][4]).value, 1.0);
  EXPECT_NEAR(std::get<Estimate>(table.rows[0][5]).value, 0.7040, 1e-5);  // t = -0.4082, 4 degrees
}

/// The column of that name in the only row of a table.
const Cell& cell_in(const Table& table, const std::string& name) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    if ((column.name.empty() ? column.header : column.name) == name) return table.rows.at(0)[c];
  }
  throw std::out_of_range(name);
}

bool says(const Table& table, const std::string& text) {
  return std::ranges::any_of(
      table.notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

ComparisonRequest of_pairwise_and_rigid() {
  ComparisonRequest request;
  request.name = "d";
  request.factor = "behaviour";
  request.reference = pairwise;
  request.measures = {"energy_mean_wh"};
  return request;
}

TEST_F(Stored, ATableSaysWhatItsTestCanShowAtAll) {
  const StudyResults all = results({{{rigid, "10"}, low}, {{pairwise, "10"}, high}});
  const Table table = difference_table(of_pairwise_and_rigid(), all);
  EXPECT_TRUE(says(table,
                   "The least p that a sign-flip test of 5 differences can give, of 1 "
                   "comparison, is 0.062: no difference could be significant here, however "
                   "large; 6 replications are the fewest that could."));
  const auto& p = std::get<Estimate>(cell_in(table, "p_value"));
  EXPECT_EQ(p.value, 2.0 / 32.0);
  ASSERT_EQ(p.remarks.size(), 1u);
  EXPECT_EQ(p.remarks.front(), "The least p that these 5 differences can give.");
  EXPECT_LT(std::get<Estimate>(cell_in(table, "p_value_t")).value, 1e-4);
  // The differences scatter by 0.27 Wh, and 5 % of the mean are 1.1 Wh.
  EXPECT_EQ(std::get<Estimate>(cell_in(table, "replications_needed")).value, 6.0);
  EXPECT_EQ(std::get<Estimate>(cell_in(table, "replications_needed_t")).value, 3.0);
}

TEST_F(Stored, DifferencesThatHardlyVaryHaveATable) {
  for (const double noise : {0.0, 1e-15, 1e-13, 1e-10}) {
    std::vector<double> shifted;
    for (std::size_t k = 0; k < low.size(); ++k) {
      shifted.push_back(low[k] + 0.0867 + (k % 2 == 0 ? noise : -noise));
    }
    const StudyResults all = results({{{rigid, "10"}, shifted}, {{pairwise, "10"}, low}});
    const Table table = difference_table(of_pairwise_and_rigid(), all);
    EXPECT_NEAR(std::get<Estimate>(cell_in(table, "difference")).value, 0.0867, 1e-9);
    EXPECT_EQ(std::get<Estimate>(cell_in(table, "replications_needed_t")).value, 2.0) << noise;
    EXPECT_FALSE(as_latex(table).empty());
  }
}

TEST_F(Stored, NumbersTooLargeToSubtractCostOneTableOnly) {
  const double most = std::numeric_limits<double>::max();
  const std::string tables_wanted = R"(
[[table]]
name = "a"
rows = ["behaviour"]
columns = ["period"]
measures = ["energy_mean_wh"]
statistic = "mean"
[[comparison]]
name = "b"
factor = "behaviour"
reference = "pairwise_referencing"
measures = ["energy_mean_wh"]
)";
  const Energies energies{{{rigid, "10"}, {most, 1, 2, 3, 4}},
                          {{pairwise, "10"}, {-most, 1, 2, 3, 4}}};
  const std::vector<Table> tables = study_tables(results(energies, two_factors + tables_wanted));
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].rows.size(), 2u);
  EXPECT_EQ(tables[1].columns.front().header, "not computed");
  EXPECT_FALSE(as_latex(tables[1]).empty());
}

/// Times to a quality; a negative one is the end of a watch that did not see it.
class StoredTimes : public Stored {
 protected:
  StudyResults times(const std::vector<double>& ours, const std::vector<double>& theirs) {
    const TrialList list(read_study(scenarios::parse_toml(two_factors, "study.toml")));
    Store store(folder_, Store::Access::write);
    const TrialGroup& group = list.groups().front();
    for (const ListedTrial& planned : list.all_trials()) {
      const auto labels = group.labels(planned.cell);
      if (labels[1] != "10") continue;  // not run
      const auto k = static_cast<std::size_t>(planned.replication);
      const double time_s = (labels[0] == rigid ? ours : theirs).at(k);
      StoredTrial trial = planned_trial(list, planned);
      trial.program = "test";
      trial.measures = {
          {"time_to_quality_20m_s", time_s > 0.0 ? std::optional(time_s) : std::nullopt},
          {"quality_watched_s", time_s > 0.0 ? 3600.0 : -time_s}};
      store.write(trial);
    }
    return {list, store, {"time_to_quality_20m_s"}, {}};
  }
};

TEST_F(StoredTimes, CountWithTheEndOfTheWatchWhereTheEventNeverCame) {
  const StudyResults all = times({1000, -3600, 1200, -3600, 800}, {1100, 1400, 1300, 1200, 1000});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.columns = {"period"};
  request.measures = {"time_to_quality_20m_s"};
  const Table table = cell_table(request, all);
  const auto& mean = std::get<Estimate>(table.rows[0][1]);
  EXPECT_EQ(mean.value, 2040.0) << "those that reached it took 1000 on average";
  EXPECT_EQ(mean.reached, 3);
  EXPECT_EQ(mean.n, 5);
  EXPECT_NE(as_text(table).find("(3 of 5)"), std::string::npos);
  EXPECT_TRUE(says(table, "restricted means up to 3600 s"));
  EXPECT_EQ(std::get<Missing>(table.rows[0][2]).not_run, 5);
  EXPECT_EQ(std::get<Missing>(table.rows[0][2]).failed, 0);

  ComparisonRequest compared = of_pairwise_and_rigid();
  compared.measures = request.measures;
  const Table differences = difference_table(compared, all);
  EXPECT_EQ(std::get<Estimate>(cell_in(differences, "difference")).value, 2040.0 - 1200.0);
  EXPECT_EQ(std::get<Estimate>(cell_in(differences, "difference")).n, 5);
  const auto& p = std::get<Estimate>(cell_in(differences, "p_value_log_rank"));
  EXPECT_GT(p.value, 0.05);
  EXPECT_LT(p.value, 1.0);
}

TEST_F(Stored, SamplesOfTwoKindsAreSaidToBe) {
  std::vector<double> most{40, 41, 42, 43, 41.5};
  StudyResults all = results({{{rigid, "10"}, most}, {{rigid, "20"}, {42, 43, 41, 44, 121}}});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.columns = {"period"};
  request.measures = {"energy_mean_wh"};
  const Table table = cell_table(request, all);
  EXPECT_TRUE(std::get<Estimate>(table.rows[0][1]).remarks.empty());
  ASSERT_EQ(std::get<Estimate>(table.rows[0][2]).remarks.size(), 1u);
  EXPECT_EQ(std::get<Estimate>(table.rows[0][2]).remarks.front(),
            "Two kinds: 4 of 5 at 42.5, 1 of 5 at 121.");
  EXPECT_TRUE(says(table, "two groups explain 90 % of the variance"));
}

}  // namespace
}  // namespace shoal::analysis
