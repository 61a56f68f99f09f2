#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "shoal/analysis/study/cell_table.hpp"
#include "shoal/analysis/study/difference_table.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/core/settings.hpp"

namespace shoal::analysis {
namespace {

using tests::complaint_of;

const char* const study_text = R"(
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

  StudyResults results(const Energies& energies) {
    const StudyPlan plan(read_study(scenarios::parse_toml(study_text, "study.toml")));
    Store store(folder_, Store::Access::write);
    const PlannedGroup& group = plan.groups().front();
    for (const PlannedTrial& planned : plan.all_trials()) {
      StoredTrial trial;
      trial.key = group.key(planned.cell, planned.replication);
      trial.program = "test";
      const auto labels = group.labels(planned.cell);
      const auto found = energies.find({labels[0], labels[1]});
      if (found == energies.end()) {
        trial.failure = "it sank";
      } else {
        const auto k = static_cast<std::size_t>(planned.replication);
        trial.metrics = {{"energy_mean_wh", found->second.at(k)}};
      }
      store.write(trial);
    }
    return {plan, store, {"energy_mean_wh"}, {}};
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
  request.metrics = {"energy_mean_wh"};
  request.best = Best::lowest;
  request.compare = "behaviour";
  request.test = PairedTest::paired_t;
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
  request.test = PairedTest::sign_flip;
  EXPECT_FALSE(std::get<Estimate>(cell_table(request, all).rows[0][1]).best);
}

TEST_F(Stored, NotRunFailedUndefinedAndNeverReachedAreFourAnswers) {
  using enum Answer::Kind;
  const StudyPlan plan(read_study(scenarios::parse_toml(study_text, "study.toml")));
  Store store(folder_, Store::Access::write);
  using Metrics = std::vector<std::pair<std::string, std::optional<double>>>;
  const std::vector<Metrics> trials{
      {{"time_to_quality_20m_s", 600.0}, {"quality_watched_s", 3600.0}, {"path_straightness", 0.9}},
      {{"time_to_quality_20m_s", {}}, {"quality_watched_s", 3600.0}, {"path_straightness", 0.5}},
      {{"time_to_quality_20m_s", {}}, {"quality_watched_s", {}}, {"path_straightness", {}}},
      {}};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const PlannedTrial& planned = plan.trial(i);
    StoredTrial trial;
    trial.key = plan.groups().front().key(planned.cell, planned.replication);
    trial.program = "test";
    trial.metrics = trials[i];
    if (trials[i].empty()) trial.failure = "it sank";
    store.write(trial);
  }
  const StudyResults all(plan, store, {"time_to_quality_20m_s", "path_straightness"}, {});
  const auto answer = [&](const char* metric, std::size_t i) {
    const Answer found = all.answer({.metric = metric}, i);
    return std::pair(found.kind, found.number);
  };
  for (const std::size_t i : {0, 1, 2, 3, 4}) {
    const Answer::Kind kinds[]{value, never_reached, undefined, failed, not_run};
    EXPECT_EQ(answer("time_to_quality_20m_s", i), std::pair(kinds[i], i == 0   ? 600.0
                                                                      : i == 1 ? 3600.0
                                                                               : 0.0));
    EXPECT_EQ(answer("path_straightness", i), std::pair(kinds[i], i == 0   ? 0.9
                                                                  : i == 1 ? 0.5
                                                                           : 0.0));
  }
  EXPECT_EQ(all.answer({.metric = "time_to_quality_20m_s"}, 1).bounded(), 3600.0);
  EXPECT_EQ(all.stored("time_to_quality_20m_s", 1), std::nullopt);
}

TEST_F(Stored, AFactorIsNotAveragedInSilence) {
  const StudyResults all = results({{{rigid, "10"}, low}, {{rigid, "20"}, high}});
  TableRequest request;
  request.name = "t";
  request.rows = {"behaviour"};
  request.metrics = {"energy_mean_wh"};
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
  request.metrics = {"energy_mean_wh"};
  const Table table = difference_table(request, all);
  const auto& difference = std::get<Estimate>(table.rows[0][3]);
  EXPECT_NEAR(difference.value, -0.2, 1e-12);  // -1, 1, -1, 1, -1
  EXPECT_EQ(difference.n, 5);
  // 20 of 32 patterns of signs sum to -1 or 1, the others lie further out: all are as far out.
  EXPECT_EQ(std::get<Estimate>(table.rows[0][4]).value, 1.0);
}

}  // namespace
}  // namespace shoal::analysis
