#include <gtest/gtest.h>

#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/core/settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace shoal::analysis {
namespace {

using tests::complaint_of;

/// A study of one cell, its scenario and a file that the scenario names, all of which may change.
class CellIdentity : public testing::Test {
 protected:
  std::string identity(const std::string& study_more = "") {
    folder_.write("sea.toml", scenario_);
    folder_.write("plan.csv", plan_);
    const auto study = folder_.write("study.toml", "scenario = \"" + base_ + "\"\n" + study_more);
    const TrialList list(read_study(scenarios::read_toml(study)));
    return CellScenarios(list).of(0, 0).identity;
  }

  tests::ScratchFolder folder_;
  std::string base_ = "sea.toml";
  std::string scenario_ =
      "[trial]\nduration_s = 60\n[plan]\nkind = \"file\"\nfile.path = \"plan.csv\"\n";
  std::string plan_ = "name,x_m,y_m\na,0,0\nb,300,0\n";
};

TEST_F(CellIdentity, IsTheSameForWhatMeansTheSame) {
  const std::string before = identity();
  scenario_ =
      "# a comment\nplan.file.path = \"plan.csv\"   # and another\nplan.kind = \"file\"\n"
      "trial = { duration_s = 60.0 }\n";
  EXPECT_EQ(identity(), before);
  EXPECT_EQ(identity("title = \"another\"\nreplications = 9\nseries = [\"quality\"]\n"), before);
}

TEST_F(CellIdentity, ChangesWithTheScenario) {
  const std::string before = identity();
  EXPECT_NE(identity("set = { trial.duration_s = 61 }\n"), before);
  EXPECT_EQ(identity("set = { trial.duration_s = 60 }\n"), before);
  scenario_ += "[ping]\nperiod_s = 31\n";
  EXPECT_NE(identity(), before);
}

TEST_F(CellIdentity, ChangesWithTheContentOfAFileBehindTheScenario) {
  const std::string before = identity();
  plan_ = "name,x_m,y_m\na,0,0\nb,301,0\n";
  EXPECT_NE(identity(), before);
}

TEST_F(CellIdentity, DoesNotDependOnWhereFilesStand) {
  const std::string before = identity();
  std::filesystem::create_directories(folder_.path() / "below");
  folder_.write("below/moved.csv", plan_);
  folder_.write("below/moved.toml",
                "[trial]\nduration_s = 60\n[plan]\nkind = \"file\"\nfile.path = \"moved.csv\"\n");
  base_ = "below/moved.toml";
  EXPECT_EQ(identity(), before);
}

TEST_F(CellIdentity, DoesNotDependOnSeedOrRecording) {
  const std::string before = identity();
  EXPECT_EQ(identity("seed = 5\n"), before);
  scenario_.replace(0, 8, "[trial]\nseed = 4\nrecord_every_s = 1\n");
  EXPECT_EQ(identity(), before);
  EXPECT_NE(trial_identity(before, 1), trial_identity(before, 2));
}

TEST_F(CellIdentity, TellsCellsApart) {
  identity();
  const auto study = folder_.write("study.toml",
                                   "scenario = \"sea.toml\"\n[[factor]]\nkey = \"ping.period_s\"\n"
                                   "values = [15, 30]\n");
  const TrialList list(read_study(scenarios::read_toml(study)));
  CellScenarios cells(list);
  EXPECT_NE(cells.of(0, 0).identity, cells.of(0, 1).identity);
  EXPECT_EQ(cells.of(0, 0).identity, cells.of(0, 0).identity);
}

TEST_F(CellIdentity, CannotBeToldOfAFileThatIsMissing) {
  scenario_.replace(scenario_.find("plan.csv"), 8, "gone.csv");
  EXPECT_THROW(identity(), std::runtime_error);
  base_ = "gone.toml";
  EXPECT_NE(complaint_of([&] { identity(); }).find("gone.toml"), std::string::npos);
}

}  // namespace
}  // namespace shoal::analysis
