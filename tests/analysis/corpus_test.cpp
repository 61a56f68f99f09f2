#include "shoal/analysis/benchmarking/corpus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "shoal/analysis/benchmarking/problem_recorder.hpp"
#include "shoal/analysis/benchmarking/solver_comparison.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/behaviour_choice.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

class Corpora : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "shoal_corpus_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path written(const std::string& text) const {
    std::ofstream(folder / "bad.jsonl") << text;
    return folder / "bad.jsonl";
  }

  fs::path folder;
};

scenarios::Scenario scenario(const std::string& behaviour) {
  Setting root = scenarios::read_toml(scenarios::find_scenario("construction_square"));
  scenarios::choose_behaviour(root, behaviour);
  scenarios::apply_set(root, "trial.duration_s=300");
  scenarios::apply_set(root, "behaviour.rigid_registration.ownship_weight=0.1");
  return scenarios::read_scenario(root);
}

Corpus recorded(const scenarios::Scenario& wanted, int threads = 1) {
  ProblemRecorder recorder;
  const Trial trial = run_trial(
      wanted, {.threads = threads, .record = false, .plan_observer = recorder.of_trial()});
  return recorder.corpus(wanted, "construction_square", trial.world->plan());
}

/// Every `nth` situation: the sanitizers take a hundred times as long for a search of slots.
void thin(Corpus& corpus, std::size_t nth) {
  std::size_t k = 0;
  std::erase_if(corpus.situations, [&](const Situation&) { return k++ % nth != 0; });
}

void expect_same(const Corpus& a, const Corpus& b) {
  ASSERT_EQ(a.experiments.size(), b.experiments.size());
  for (std::size_t k = 0; k < a.experiments.size(); ++k) {
    ASSERT_EQ(a.experiments[k].waypoint, b.experiments[k].waypoint);
  }
  ASSERT_EQ(a.situations.size(), b.situations.size());
  for (std::size_t k = 0; k < a.situations.size(); ++k) {
    const Situation &left = a.situations[k], &right = b.situations[k];
    ASSERT_EQ(left.own_slot, right.own_slot);
    ASSERT_EQ(left.own.position, right.own.position);
    ASSERT_EQ(left.own.velocity, right.own.velocity);
    ASSERT_EQ(left.own.heading_rad, right.own.heading_rad);
    ASSERT_EQ(left.neighbours.size(), right.neighbours.size());
    for (std::size_t i = 0; i < left.neighbours.size(); ++i) {
      ASSERT_EQ(left.neighbours[i].position, right.neighbours[i].position);
      ASSERT_EQ(left.neighbours[i].age_s, right.neighbours[i].age_s);
      ASSERT_EQ(left.neighbours[i].slot, right.neighbours[i].slot);
      ASSERT_EQ(left.neighbours[i].velocity, right.neighbours[i].velocity);
      ASSERT_EQ(left.neighbours[i].heading_rad, right.neighbours[i].heading_rad);
    }
  }
}

TEST_F(Corpora, PoseTheSameProblemsAgainBitForBitAfterAFile) {
  for (const std::string& behaviour : Registry<formations::Behaviour>::instance().names()) {
    const Corpus corpus = recorded(scenario(behaviour));
    if (behaviour == "virtual_potential" || behaviour == "pair_forces") {
      EXPECT_TRUE(corpus.situations.empty());  // the answer is a gradient, not that of a problem
      continue;
    }
    ASSERT_GT(corpus.situations.size(), 100u) << behaviour;
    write_corpus(corpus, folder / "c.jsonl");
    Corpus again = read_corpus(folder / "c.jsonl");
    expect_same(corpus, again);

    const auto before = scenario(behaviour).behaviour.make();
    const auto after = again.experiments[0].make_behaviour();
    const auto sea = scenarios::make_obstacles(again.experiments[0].obstacles);
    thin(again, 10);
    for (const Situation& s : again.situations) {
      const formations::Neighbourhood seen{
          s.neighbours, s.own_slot, s.own, sea,
          again.experiments[0].waypoint.value_or(Eigen::Vector2d::Zero())};
      const formations::Target a = before->step(seen, corpus.experiments[0].plan);
      const formations::Target b = after->step(seen, again.experiments[0].plan);
      ASSERT_EQ(a.position, b.position) << behaviour;
      ASSERT_EQ(a.cost, b.cost) << behaviour;
    }
  }
}

TEST_F(Corpora, DoNotDependOnThreadsAndLeaveTheTrialAlone) {
  const scenarios::Scenario wanted = scenario("rigid_registration");
  expect_same(recorded(wanted, 1), recorded(wanted, 3));
  ProblemRecorder recorder;
  const Trial with = run_trial(wanted, {.record = false, .plan_observer = recorder.of_trial()});
  const Trial without = run_trial(wanted, {.record = false});
  EXPECT_EQ(with.results.values, without.results.values);
}

TEST_F(Corpora, HoldSituationsSpreadOverTimeWhereTheyAreLimited) {
  const scenarios::Scenario wanted = scenario("rigid_registration");
  const Corpus all = recorded(wanted);
  for (const std::size_t most : {1u, 2u, 3u, 7u}) {
    ProblemRecorder recorder(most);
    const Trial trial = run_trial(wanted, {.record = false, .plan_observer = recorder.of_trial()});
    EXPECT_EQ(recorder.situations(), all.situations.size());
    const Corpus some = recorder.corpus(wanted, "construction_square", trial.world->plan());
    const auto of = [](const Corpus& corpus, int slot) {
      std::vector<Situation> found;
      std::ranges::copy_if(corpus.situations, std::back_inserter(found),
                           [&](const Situation& s) { return s.own_slot == slot; });
      return found;
    };
    for (int slot = 0; slot < trial.world->plan().size(); ++slot) {
      const auto whole = of(all, slot), kept = of(some, slot);
      std::size_t stride = 1;
      while ((whole.size() + stride - 1) / stride > most) stride *= 2;
      ASSERT_GT(stride, 1u);
      ASSERT_EQ(kept.size(), (whole.size() + stride - 1) / stride);
      for (std::size_t k = 0; k < kept.size(); ++k) {
        const Situation& same = whole[k * stride];
        EXPECT_EQ(kept[k].own.position, same.own.position);
        ASSERT_EQ(kept[k].neighbours.size(), same.neighbours.size());
        for (std::size_t n = 0; n < same.neighbours.size(); ++n) {
          EXPECT_EQ(kept[k].neighbours[n].position, same.neighbours[n].position);
        }
      }
    }
  }
}

TEST_F(Corpora, KeepApartWhatWasAppended) {
  Corpus corpus = recorded(scenario("rigid_registration"));
  const std::size_t first = corpus.situations.size();
  corpus.append(recorded(scenario("attraction_repulsion")));
  ASSERT_EQ(corpus.experiments.size(), 2u);
  EXPECT_EQ(corpus.situations[first - 1].experiment, 0u);
  EXPECT_EQ(corpus.situations[first].experiment, 1u);
}

TEST_F(Corpora, AreRefusedWithTheLineThatIsWrong) {
  const auto complaint = [](const fs::path& file) -> std::string {
    try {
      read_corpus(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string good = R"({"scenario":"s","behaviour":{"kind":"rigid_registration"},)"
                           R"("plan":[["a",0,0],["b",9,0]],"obstacles":[]})"
                           "\n";
  const std::string name = (folder / "bad.jsonl").string();
  const std::string no_line = "this is no line of a corpus; shoal run --record-problems writes one";
  EXPECT_EQ(complaint(written("")), name + ": holds no problem");
  EXPECT_EQ(complaint(written(good)), name + ": holds no problem");
  EXPECT_EQ(complaint(written(good + "{\"experiment\":0}\n")), name + ":2: " + no_line);
  EXPECT_EQ(complaint(written(good + "nonsense\n")), name + ":2: " + no_line);
  EXPECT_EQ(complaint(written("[1, 2]\n")), name + ":1: " + no_line);
  const std::string at_rest = "[0,0,0,0,0,0,0]";
  const auto situation = [&](const std::string& experiment, const std::string& slot,
                             const std::string& own, const std::string& heard = "") {
    return complaint(written(good + R"({"experiment":)" + experiment + R"(,"slot":)" + slot +
                             R"(,"own":)" + own + R"(,"heard":[)" + heard + "]}"));
  };
  EXPECT_EQ(situation("1", "0", at_rest), name + ":2: there is no experiment 1 above this line");
  EXPECT_EQ(situation("0.5", "0", at_rest), name + ":2: experiment is 0.5; it is a whole number");
  EXPECT_EQ(situation("0", "2", at_rest), name + ":2: the plan has no slot 2");
  EXPECT_EQ(situation("0", "0.5", at_rest), name + ":2: slot is 0.5; it is a whole number");
  EXPECT_EQ(situation("0", "0", "[0,0,0,0,0,0,0,0]"),
            name + ":2: own is a list of 7 entries; here it is one of 8");
  EXPECT_EQ(situation("0", "0", "{}"), name + ":2: own is a list of 7 entries; here it is object");
  EXPECT_EQ(situation("0", "0", "[0,0,0,null,0,0,0]"),
            name + ":2: own has null where a number stands");
  EXPECT_EQ(situation("0", "0", at_rest, "[1,2,3,-2,0,0,0]"), name + ":2: the plan has no slot -2");
  EXPECT_EQ(situation("0", "0", at_rest, "[1,2,3,1.5,0,0,0]"),
            name + ":2: the slot of an entry of heard is 1.5; it is a whole number");
  EXPECT_EQ(complaint(folder / "nowhere"), "cannot open " + (folder / "nowhere").string());
}

TEST_F(Corpora, AreReadUpToALimitThoughAllLinesAreGood) {
  const std::string line = R"({"scenario":"s","behaviour":{"kind":"rigid_registration"},)"
                           R"("plan":[["a",0,0],["b",9,0]],"obstacles":[]})"
                           "\n";
  const fs::path file = written(line + line + line);
  const std::string why =
      tests::complaint_of([&] { read_corpus(file, 2 * line.size() + line.size() / 2); });
  EXPECT_TRUE(why.starts_with(file.string() + ":3: here the file holds more than ")) << why;
}

// The comparison ----------------------------------------------------------------------------------

TEST_F(Corpora, AreSolvedByTheSolversOfTheirFamilies) {
  Corpus corpus = recorded(scenario("attraction_repulsion"));
  corpus.append(recorded(scenario("rigid_registration")));
  corpus.append(recorded(scenario("assignment_registration")));
  thin(corpus, 20);
  SolverComparison comparison({.solvers = {"newton", "nlopt.slsqp", "procrustes", "sampled"},
                               .reference = "",
                               .options = {}});
  comparison.run(corpus);
  const auto families = comparison.families();
  ASSERT_EQ(families.size(), 3u);
  for (const ContenderFamily* family : families) {
    for (const Contender& contender : family->contenders) {
      EXPECT_EQ(contender.answers.size(), family->contenders.front().answers.size());
      if (contender.name == "nlopt.slsqp") continue;  // it stops early in flat valleys
      for (const SolverAnswer& answer : contender.answers)
        EXPECT_TRUE(answer.solved()) << name_of(answer.status);
    }
  }
  const std::string table = as_csv(comparison_table(comparison, 0.01));
  EXPECT_EQ(std::ranges::count(table, '\n'), 6) << table;  // newton is in two families
}

TEST_F(Corpora, OfEveryBehaviourAreSolvedFromAFile) {
  for (const std::string& behaviour : Registry<formations::Behaviour>::instance().names()) {
    Corpus corpus = recorded(scenario(behaviour));
    thin(corpus, 10);
    if (corpus.situations.empty()) continue;  // its answer is a gradient
    write_corpus(corpus, folder / "c.jsonl");
    SolverComparison comparison({.solvers = {"newton", "nlopt.bobyqa", "procrustes", "sampled"},
                                 .reference = "",
                                 .options = {}});
    comparison.run(read_corpus(folder / "c.jsonl"));
    EXPECT_FALSE(comparison.families().empty()) << behaviour;
  }
}

TEST_F(Corpora, GiveProfilesThatRiseToTheShareSolved) {
  SolverComparison comparison(
      {.solvers = {"newton", "nlopt.bobyqa", "grid"}, .reference = "", .options = {}});
  comparison.run(recorded(scenario("attraction_repulsion")));
  const std::string profiles = as_csv(performance_profiles(comparison));
  EXPECT_NE(profiles.find("solver,evaluations,newton,1,1\n"), std::string::npos);
  EXPECT_NE(profiles.find("solver,evaluations,nlopt.bobyqa,1,0\n"), std::string::npos);
  EXPECT_NE(profiles.find("solver,seconds,nlopt.bobyqa,16384,1\n"), std::string::npos);
  EXPECT_NE(profiles.find("solver,seconds,grid,16384,0\n"), std::string::npos);
}

TEST_F(Corpora, GiveProgressThatFallsToTheLowestCost) {
  SolverComparison comparison({.solvers = {"newton", "nlopt.bobyqa", "grid", "procrustes"},
                               .reference = "",
                               .options = {},
                               .progress = true});
  comparison.run(recorded(scenario("attraction_repulsion")));
  const ContenderFamily& family = *comparison.families().front();
  for (const SolverAnswer& answer : family.contenders.front().answers) {
    ASSERT_FALSE(answer.progress.empty());
    EXPECT_EQ(answer.progress.back().cost, answer.cost);
  }
  const Table table = progress_curves(comparison);
  std::string name;
  double before = 1.0;
  std::map<std::string, double> last;
  for (const auto& row : table.rows) {
    const std::string next = std::get<std::string>(row[1]) + " " + std::get<std::string>(row[2]);
    if (next != name) before = 1.0;
    name = next;
    const double left = std::get<Estimate>(row[4]).value;
    EXPECT_LE(std::get<Estimate>(row[5]).value, left);
    EXPECT_GE(std::get<Estimate>(row[6]).value, left);
    EXPECT_LE(left, before) << name;
    last[name] = before = left;
  }
  EXPECT_LT(last.at("evaluations newton"), 1e-9);
  EXPECT_LT(last.at("seconds nlopt.bobyqa"), 1e-6);
  EXPECT_EQ(last.at("evaluations grid"), 1.0) << "it refuses problems without bounds";
}

TEST_F(Corpora, GiveNoProgressOfAClosedForm) {
  SolverComparison comparison({.solvers = {"newton", "procrustes", "sampled"},
                               .reference = "",
                               .options = {},
                               .progress = true});
  Corpus corpus = recorded(scenario("rigid_registration"));
  corpus.append(recorded(scenario("assignment_registration")));
  comparison.run(corpus);
  const Table table = progress_curves(comparison);
  EXPECT_FALSE(table.rows.empty());
  for (const auto& row : table.rows) EXPECT_EQ(std::get<std::string>(row[2]), "newton");
}

TEST_F(Corpora, AreNotComparedWithOptionsThatNoNamedSolverHas) {
  const auto complaint = [](const char* key, Setting value) -> std::string {
    ComparisonSettings settings{
        .solvers = {"newton", "procrustes"}, .reference = "", .options = {}};
    assign(settings.options, key, std::move(value));
    try {
      const SolverComparison comparison(settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Setting three{std::int64_t{3}, {}};
  EXPECT_EQ(complaint("solver.newton.max_evaluations", three), "");
  EXPECT_NE(complaint("solver.newton.foo", three).find("no option \"foo\""), std::string::npos);
  EXPECT_NE(complaint("solver.nonsense.foo", three).find("no option \"nonsense\""),
            std::string::npos);
  EXPECT_NE(complaint("solver.nlopt.slsqp.max_evaluations", three).find("not among the solvers"),
            std::string::npos);
  EXPECT_NE(complaint("solver", three).find("it takes a table"), std::string::npos);
  EXPECT_NE(complaint("solver.kind", three).find("--solvers"), std::string::npos);
}

TEST_F(Corpora, AreNotComparedByUnknownSolversOrReferences) {
  const auto complaint = [](const ComparisonSettings& settings) -> std::string {
    try {
      const SolverComparison comparison(settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({.solvers = {"newton", "nlopt.slsq"}, .reference = "", .options = {}}),
            "there is no solver \"nlopt.slsq\"; did you mean \"nlopt.slsqp\"?");
  EXPECT_EQ(complaint({.solvers = {"newton"}, .reference = "neton", .options = {}}),
            "the reference \"neton\" is not among the solvers; did you mean \"newton\"?");
  Setting options;
  scenarios::apply_set(options, "solver.newton.x_tolerance=1e-6");
  EXPECT_NE(complaint({.solvers = {"newton"}, .reference = "", .options = options})
                .find("did you mean \"x_tolerance_m\"?"),
            std::string::npos);
  Setting wrong_family;
  scenarios::apply_set(wrong_family, "newton.x_tolerance_m=1e-6");
  EXPECT_NE(complaint({.solvers = {"newton"}, .reference = "", .options = wrong_family})
                .find("there is no family of solvers \"newton\""),
            std::string::npos);
}

}  // namespace
}  // namespace shoal::analysis
