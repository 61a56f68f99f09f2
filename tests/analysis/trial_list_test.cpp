#include "shoal/analysis/experiments/study/trial_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shoal/scenarios/toml_file.hpp"
#include "tests/core/settings.hpp"

namespace shoal::analysis {
namespace {

using tests::complaint_of;

TrialList listed(const std::string& text) {
  return TrialList(read_study(scenarios::parse_toml(text, "study.toml")));
}

const std::string base = "scenario = \"construction_square\"\nreplications = 2\n";
const std::string behaviours =
    "[[factor]]\nname = \"behaviour\"\nkey = \"behaviour.kind\"\n"
    "values = [\"rigid_registration\", \"assignment_registration\"]\n";
const std::string periods = "[[factor]]\nkey = \"ping.period_s\"\nvalues = [15, 30, 60]\n";

std::vector<std::string> titles(const TrialGroup& group) {
  std::vector<std::string> all;
  for (std::size_t cell = 0; cell < group.cells(); ++cell) all.push_back(group.title(cell));
  return all;
}

TEST(TrialList, TheLastFactorRunsFastestAndReplicationsWithinCells) {
  const TrialList list = listed(base + "seed = 7\n" + behaviours + periods);
  const TrialGroup& group = list.groups().front();
  EXPECT_EQ(titles(group), (std::vector<std::string>{
                               "behaviour = rigid_registration, period_s = 15",
                               "behaviour = rigid_registration, period_s = 30",
                               "behaviour = rigid_registration, period_s = 60",
                               "behaviour = assignment_registration, period_s = 15",
                               "behaviour = assignment_registration, period_s = 30",
                               "behaviour = assignment_registration, period_s = 60",
                           }));
  ASSERT_EQ(list.trials(), 12u);
  for (std::size_t i = 0; i < list.trials(); ++i) {
    EXPECT_EQ(list.trial(i).cell, i / 2);
    EXPECT_EQ(list.trial(i).replication, static_cast<int>(i % 2));
    EXPECT_EQ(list.seed(list.trial(i)), 7 + static_cast<int>(i % 2));
    EXPECT_EQ(list.index(0, list.trial(i).cell, list.trial(i).replication), i);
  }
  EXPECT_EQ(group.units(), (std::vector<std::string>{"", "s"}));
}

TEST(TrialList, AFactorMaySweepAParameterOfAFormula) {
  const std::string potential = "behaviour.attraction_repulsion.potential";
  const std::string kind = "set = { " + potential + ".kind = \"expression\" }\n";
  const TrialList list =
      listed(base + kind + "[[factor]]\nkey = \"" + potential +
             ".expression.parameters.stiffness\"\nrange = [0.5, 2]\nsteps = 2\n");
  EXPECT_EQ(titles(list.groups().front()),
            (std::vector<std::string>{"stiffness = 0.5", "stiffness = 2"}));
  EXPECT_THROW(listed(base + kind + "[[factor]]\nkey = \"" + potential +
                      ".expression.parameters\"\nvalues = [1, 2]\n"),
               InputError);
}

TEST(TrialList, FactorsWhoseColumnsWouldBeOneAreRefused) {
  const auto two = [](const std::string& first, const std::string& second) {
    return base + "[[factor]]\nname = \"" + first +
           "\"\nkey = \"ping.bearing_sd_deg\"\nvalues = [1, 2]\n[[factor]]\nname = \"" + second +
           "\"\nkey = \"ping.range_sd_m\"\nvalues = [1, 2]\n";
  };
  for (const auto& [first, second] :
       {std::pair("a", "A"), {"a b", "a#b"}, {"Noise_1", "noise 1"}}) {
    const std::string text = two(first, second);
    const std::string why = complaint_of([&] { listed(text); });
    EXPECT_NE(
        why.find("\"" + std::string(first) + "\" and \"" + second + "\" would have one column"),
        std::string::npos)
        << why;
    EXPECT_TRUE(why.starts_with("study.toml:7: ")) << why;
  }
  EXPECT_NO_THROW(listed(two("a", "b")));
  EXPECT_NO_THROW(listed(two("\u00e4", "a")));
}

TEST(TrialList, MoreTrialsThanCanBePlannedAreRefusedAtOnce) {
  const std::string many = "scenario = \"construction_square\"\nreplications = 1000000000\n";
  EXPECT_NE(complaint_of([&] { listed(many); }).find("has 1e+09 trials, and may have 1e+06"),
            std::string::npos);
}

TEST(TrialList, NamesOfTablesAreThoseOfFiles) {
  const auto named = [](const std::string& name) {
    return base + "[[table]]\nname = \"" + name +
           "\"\nrows = []\nmeasures = [\"energy_mean_wh\"]\n";
  };
  EXPECT_NO_THROW(listed(named(std::string(100, 'x'))));
  EXPECT_NE(complaint_of([&] { listed(named(std::string(300, 'x'))); }).find("takes at most 100"),
            std::string::npos);
}

TEST(TrialList, WithoutFactorsThereIsOneCell) {
  const TrialList list = listed(base);
  EXPECT_EQ(list.groups().front().cells(), 1u);
  EXPECT_EQ(list.groups().front().title(0), "");
  EXPECT_EQ(list.trials(), 2u);
}

TEST(TrialList, GroupsFollowOneAnotherEachWithItsReplications) {
  const std::string group =
      "[[group]]\nname = \"NAME\"\nscenario = \"construction_square\"\nreplications = ";
  const auto named = [&](const std::string& name) {
    std::string text = group;
    return text.replace(text.find("NAME"), 4, name);
  };
  const TrialList list =
      listed("replications = 4\n" + named("a") + "3\n" + named("b") + "0\n" + named("c") + "1\n");
  std::vector<std::size_t> groups;
  for (const ListedTrial& trial : list.all_trials()) groups.push_back(trial.group);
  EXPECT_EQ(groups, (std::vector<std::size_t>{0, 0, 0, 1, 1, 1, 1, 2}));
  EXPECT_EQ(list.index(2, 0, 0), 7u);
  EXPECT_EQ(list.title(list.trial(4)), "b, seed 2");
}

TEST(TrialList, AFactorThatDoesNotApplyMakesNoCells) {
  const TrialList list = listed(
      base + behaviours +
      "[[factor]]\nkey = \"behaviour.assignment_registration.matching.sampled.delta_theta_deg\"\n"
      "values = [10, 45]\nonly = { behaviour = \"assignment_registration\" }\n");
  const TrialGroup& group = list.groups().front();
  EXPECT_EQ(titles(group), (std::vector<std::string>{
                               "behaviour = rigid_registration",
                               "behaviour = assignment_registration, delta_theta_deg = 10",
                               "behaviour = assignment_registration, delta_theta_deg = 45",
                           }));
  EXPECT_EQ(group.labels(0)[1], not_applied);
  EXPECT_EQ(group.changes(0).size(), 1u);
  EXPECT_EQ(group.changes(1).size(), 2u);
}

TEST(TrialList, ExcludedCombinationsAreNoCells) {
  const TrialList list = listed(base + behaviours + periods +
                                "[[exclude]]\nbehaviour = \"rigid_registration\"\n"
                                "period_s = [15, 60]\n");
  EXPECT_EQ(titles(list.groups().front()).front(), "behaviour = rigid_registration, period_s = 30");
  EXPECT_EQ(list.groups().front().cells(), 4u);
  EXPECT_EQ(complaint_of([] { listed(base + periods + "[[exclude]]\nperiod_s = [15, 30, 60]\n"); }),
            "study.toml:1: every cell of the group is excluded");
  EXPECT_NE(complaint_of([] {
              listed(base + periods + "[[exclude]]\nperiod = 15\n");
            }).find("exclude names \"period\", which is no factor; did you mean \"period_s\"?"),
            std::string::npos);
}

TEST(TrialList, DrawnCellsAreNumberedFromOne) {
  const TrialList list = listed(base +
                                "design.kind = \"latin_hypercube\"\n"
                                "design.latin_hypercube.samples = 5\n"
                                "[[factor]]\nkey = \"ping.period_s\"\nrange = [5, 60]\n");
  const TrialGroup& group = list.groups().front();
  EXPECT_TRUE(group.sampled());
  EXPECT_EQ(group.columns(), (std::vector<std::string>{"sample", "period_s"}));
  ASSERT_EQ(group.cells(), 5u);
  for (std::size_t cell = 0; cell < 5; ++cell) {
    EXPECT_EQ(group.labels(cell)[0], std::to_string(cell + 1));
  }
}

TEST(TrialList, KeysTellAllTrialsApartAndDoNotDependOnTheOrderOfLevels) {
  const TrialList list = listed(base + behaviours + periods);
  const TrialList turned =
      listed(base + behaviours + "[[factor]]\nkey = \"ping.period_s\"\nvalues = [60, 5, 30, 15]\n");
  const auto keys = [](const TrialList& of) {
    std::set<std::string> all;
    for (const ListedTrial& trial : of.all_trials()) {
      all.insert(of.groups()[trial.group].key(trial.cell, trial.replication));
    }
    return all;
  };
  EXPECT_EQ(keys(list).size(), list.trials());
  EXPECT_TRUE(std::ranges::includes(keys(turned), keys(list)));
}

TEST(TrialList, ShardsPartTheTrialsEvenly) {
  const TrialList list = listed(base + behaviours + periods);  // 12 trials
  for (const int shards : {1, 2, 5, 12, 17}) {
    std::vector<std::size_t> all;
    std::size_t least = list.trials(), most = 0;
    for (int shard = 1; shard <= shards; ++shard) {
      const std::vector<std::size_t> part = list.part(shard, shards);
      all.insert(all.end(), part.begin(), part.end());
      least = std::min(least, part.size());
      most = std::max(most, part.size());
    }
    std::ranges::sort(all);
    std::vector<std::size_t> every(list.trials());
    for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
    EXPECT_EQ(all, every) << shards;
    EXPECT_LE(most - least, 1u) << shards;
  }
}

TEST(TrialList, RefusesAFactorThatIsCalledLikeWhatEveryTrialHas) {
  for (const char* name : {"seed", "status", "time", "cell", "energy_mean_wh", "quality"}) {
    const std::string said = complaint_of([&] {
      listed(base + "[[factor]]\nname = \"" + name + "\"\nkey = \"ping.period_s\"\nvalues = [1]\n");
    });
    EXPECT_TRUE(said.starts_with("study.toml:3: a factor cannot be called \"" + std::string(name)))
        << said;
  }
}

CellSelection selection(const std::string& table) {
  return CellSelection(*scenarios::parse_toml("where = " + table, "study.toml").find("where"));
}

TEST(Selection, HoldsCellsWithOneOfTheLabels) {
  const CellSelection some = selection("{ behaviour = \"rigid\", period = [5, 15] }");
  const std::vector<std::string> names{"behaviour", "period", "lost"};
  const auto holds = [&](const std::vector<std::string>& labels) {
    return some.holds(names, labels);
  };
  EXPECT_TRUE(holds({"rigid", "5", "0"}));
  EXPECT_TRUE(holds({"rigid", "15", "5"}));
  EXPECT_FALSE(holds({"rigid", "30", "0"}));
  EXPECT_FALSE(holds({"pairwise", "5", "0"}));
  EXPECT_FALSE(holds({"rigid", "-", "0"}));
  EXPECT_EQ(some.text(), "behaviour = rigid, period = 5 or 15");
}

TEST(Selection, DoesNotHoldACellWithoutItsFactor) {
  const std::vector<std::string> names{"behaviour"}, labels{"rigid"};
  EXPECT_FALSE(selection("{ period = 5 }").holds(names, labels));
  EXPECT_TRUE(CellSelection().holds(names, labels));
}

}  // namespace
}  // namespace shoal::analysis
