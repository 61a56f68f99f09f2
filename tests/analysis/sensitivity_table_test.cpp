// Tables of sensitivity, from stores whose trials "gave" known functions of their factors.

#include "shoal/analysis/experiments/results/sensitivity_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/analysis/sensitivity_functions.hpp"

namespace shoal::analysis {
namespace {

const char* const three_factors = R"(
[[factor]]
name = "a"
key = "ping.period_s"
range = [10, 11]
[[factor]]
name = "b"
key = "ping.bearing_sd_deg"
range = [0, 1]
[[factor]]
name = "c"
key = "ping.range_sd_m"
range = [0, 1]
[[sensitivity]]
name = "indices"
caption = "Indices"
measures = ["energy_mean_wh", "quality_settled_m"]
)";

class Sensitivity : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("shoal_sensitivity_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Of a study whose energy is `f` of the factors, each from 0 to 1, and whose quality is
  /// constant.
  std::vector<Table> tables(const std::string& design, const test::Function& f,
                            std::size_t failing = SIZE_MAX) {
    const TrialList list(read_study(scenarios::parse_toml(
        "scenario = \"construction_square\"\nreplications = 1\n" + design + three_factors,
        "study.toml")));
    Store store(folder_, Store::Access::write);
    const TrialGroup& group = list.groups().front();
    for (const ListedTrial& planned : list.all_trials()) {
      StoredTrial trial = planned_trial(list, planned);
      trial.program = "test";
      if (planned.cell == failing) {
        trial.failure = "it sank";
      } else {
        Eigen::RowVectorXd x(3);  // labels begin with the number of the sample
        const auto labels = group.labels(planned.cell);
        for (std::size_t i = 0; i < 3; ++i) {
          x(static_cast<Eigen::Index>(i)) = *parsed_number(labels[1 + i]) - (i == 0 ? 10.0 : 0.0);
        }
        trial.measures = {{"energy_mean_wh", f(x)}, {"quality_settled_m", 7.0}};
      }
      store.write(trial);
    }
    const StudyResults results(list, store, {"energy_mean_wh", "quality_settled_m"}, {});
    return sensitivity_tables(list.study().sensitivities.front(), results);
  }

  std::filesystem::path folder_;
};

void expect_full(const Table& table) {
  ASSERT_FALSE(table.rows.empty());
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
}

/// The interval of a cell holds the number.
void expect_holds(const Cell& cell, double number) {
  const auto& estimate = std::get<Estimate>(cell);
  const auto& interval = std::get<Between>(estimate.uncertainty);
  EXPECT_LE(interval.low, number);
  EXPECT_GE(interval.high, number);
  EXPECT_NEAR(estimate.value, number, 0.12);
}

TEST_F(Sensitivity, StatesTheAnalyticIndicesOfIshigamisFunction) {
  const test::Known known = test::ishigami(7.0, 0.1);
  const std::vector<Table> all =
      tables("[design]\nkind = \"saltelli\"\nsaltelli.base_samples = 1024\n", known.f);
  ASSERT_EQ(all.size(), 2u);
  const Table& indices = all[0];
  expect_full(indices);
  ASSERT_EQ(indices.rows.size(), 3u) << "the quality, a constant, has none";
  for (std::size_t f = 0; f < 3; ++f) {
    const auto& row = indices.rows[f];
    EXPECT_EQ(std::get<std::string>(row[0]), "energy mean");
    EXPECT_EQ(std::get<std::string>(row[1]), std::string(1, static_cast<char>('a' + f)));
    expect_holds(row[2], known.first_order[f]);
    expect_holds(row[4], known.total[f]);
    EXPECT_EQ(std::get<std::string>(row[3]), f == 2 ? "not distinguishable from 0" : "");
    EXPECT_EQ(std::get<std::string>(row[5]), "");
  }
}

TEST_F(Sensitivity, SaysWhyAConstantHasNoIndices) {
  const std::vector<Table> all = tables(
      "[design]\nkind = \"saltelli\"\nsaltelli.base_samples = 16\n", test::linear({1, 2, 3}).f);
  ASSERT_EQ(all[0].notes.size(), 3u);
  EXPECT_EQ(all[0].notes[1], "energy_mean_wh: 16 base samples.");
  EXPECT_NE(all[0].notes[2].find("quality_settled_m: 16 base samples; no indices: "),
            std::string::npos)
      << all[0].notes[2];
}

TEST_F(Sensitivity, ShowsHowIndicesConverge) {
  const test::Known known = test::sobol_g({0.0, 1.0, 9.0});
  const Table convergence =
      tables("[design]\nkind = \"saltelli\"\nsaltelli.base_samples = 256\n", known.f)[1];
  expect_full(convergence);
  EXPECT_EQ(convergence.name, "indices_convergence");
  double before = 0.0;
  for (std::size_t r = 0; r < convergence.rows.size(); r += 3) {
    const double samples = std::get<Estimate>(convergence.rows[r][2]).value;
    EXPECT_GT(samples, before);
    before = samples;
  }
  EXPECT_EQ(before, 256.0) << "the last block is that of all samples";
  const auto& last = convergence.rows[convergence.rows.size() - 3];
  EXPECT_NEAR(std::get<Estimate>(last[3]).value, known.first_order[0], 0.1);
}

TEST_F(Sensitivity, LeavesOutBaseSamplesOfWhichAnAnswerIsMissing) {
  const Table indices = tables("[design]\nkind = \"saltelli\"\nsaltelli.base_samples = 64\n",
                               test::linear({1, 2, 3}).f, 7)[0];
  EXPECT_NE(indices.notes[1].find("63 base samples, 1 left out"), std::string::npos)
      << indices.notes[1];
  expect_full(indices);
}

TEST_F(Sensitivity, StatesTheElementaryEffectsOfALinearFunction) {
  const std::vector<Table> all = tables("[design]\nkind = \"morris\"\nmorris.trajectories = 10\n",
                                        test::linear({1.0, -2.0, 0.0}).f);
  ASSERT_EQ(all.size(), 1u);
  expect_full(all[0]);
  for (std::size_t f = 0; f < 3; ++f) {
    const double effect = f == 0 ? 1.0 : f == 1 ? -2.0 : 0.0;
    EXPECT_NEAR(std::get<Estimate>(all[0].rows[f][2]).value, effect, 1e-6);
    EXPECT_NEAR(std::get<Estimate>(all[0].rows[f][3]).value, std::abs(effect), 1e-6);
    EXPECT_NEAR(std::get<Estimate>(all[0].rows[f][4]).value, 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace shoal::analysis
