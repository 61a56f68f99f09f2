#include <gtest/gtest.h>

#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;

class Inherits : public testing::Test {
 protected:
  fs::path written(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    return folder_.write(name, text);
  }

  static Inheritance filled(const fs::path& file, std::initializer_list<std::string> sets = {}) {
    Setting root = read_toml(file);
    for (const std::string& set : sets) apply_set(root, set);
    TomlFiles files;
    return with_inherited(std::move(root), files);
  }

  static std::string text_of(const fs::path& file, std::initializer_list<std::string> sets = {}) {
    return to_toml(filled(file, sets).settings);
  }

  static Scenario scenario_of(const fs::path& file, std::initializer_list<std::string> sets = {}) {
    Setting root = read_toml(file);
    for (const std::string& set : sets) apply_set(root, set);
    return read_scenario(root);
  }

  static std::string complaint(const fs::path& file, std::initializer_list<std::string> sets = {}) {
    try {
      scenario_of(file, sets);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  tests::ScratchFolder folder_;
};

TEST_F(Inherits, OwnSettingsHoldBeforeThoseOfTheSetAndThoseBeforeDefaults) {
  const fs::path file = written("own.toml", "inherits = \"program\"\n[ping]\nperiod_s = 7\n");
  const Scenario scenario = scenario_of(file);
  EXPECT_EQ(scenario.ping.period_s, 7.0);
  EXPECT_EQ(scenario.planner.update, PlannerOptions::Update::tick);
  EXPECT_EQ(scenario.trial.duration_s, TrialOptions{}.duration_s);
}

TEST_F(Inherits, SetHoldsBeforeTheFile) {
  const fs::path file = written("own.toml", "inherits = \"program\"\n[ping]\nperiod_s = 7\n");
  EXPECT_EQ(scenario_of(file, {"ping.period_s=9"}).ping.period_s, 9.0);
  const Scenario text = scenario_of(file, {"inherits=text"});
  EXPECT_EQ(text.planner.update, PlannerOptions::Update::ping);
  EXPECT_EQ(text.ping.period_s, 7.0);
  const Scenario alone = scenario_of(file, {"inherits=[]", "planner.update=tick"});
  EXPECT_EQ(to_toml(resolved_scenario(alone)),
            to_toml(resolved_scenario(scenario_of(
                written("alone.toml", "[ping]\nperiod_s = 7\n[planner]\nupdate = \"tick\"\n")))));
}

TEST_F(Inherits, LaterOnesHoldBeforeEarlierOnes) {
  written("a.toml", "[t]\nx = 1\ny = 1\nz = 1\n");
  written("b.toml", "[t]\ny = 2\nz = 2\n");
  EXPECT_EQ(text_of(written("c.toml", "inherits = [\"a.toml\", \"./b.toml\"]\n[t]\nz = 3\n")),
            "[t]\nz = 3\ny = 2\nx = 1\n");
  EXPECT_EQ(text_of(written("d.toml", "inherits = [\"b.toml\", \"a.toml\"]\n")),
            "[t]\nx = 1\ny = 1\nz = 1\n");
}

TEST_F(Inherits, WhatIsInheritedInheritsToo) {
  written("base/ground.toml", "[t]\nx = 1\ny = 1\n");
  written("base/middle.toml", "inherits = \"ground.toml\"\n[t]\ny = 2\n");
  const fs::path top = written("top.toml", "inherits = \"base/middle.toml\"\n[u]\nz = 3\n");
  EXPECT_EQ(text_of(top), "[u]\nz = 3\n\n[t]\ny = 2\nx = 1\n");
  EXPECT_EQ(filled(top).files,
            (std::vector<fs::path>{fs::canonical(folder_.path() / "base/middle.toml"),
                                   fs::canonical(folder_.path() / "base/ground.toml")}));
}

TEST_F(Inherits, ListsAreReplacedAsAWhole) {
  written("two.toml",
          "[[obstacle]]\nshape.kind = \"circle\"\n[[obstacle]]\nshape.kind = \"rectangle\"\n");
  const std::string one = "[[obstacle]]\nshape.kind = \"ellipse\"\n";
  EXPECT_EQ(scenario_of(written("none.toml", "inherits = \"two.toml\"\n")).obstacles.size(), 2U);
  const auto own = scenario_of(written("one.toml", "inherits = \"two.toml\"\n" + one)).obstacles;
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0].shape.kind(), "ellipse");
}

TEST_F(Inherits, AnotherKindTakesNothingFromTheInheritedOne) {
  written("base.toml", "[plan]\nkind = \"square\"\nsquare = { rows = 7, columns = 3 }\n");
  const fs::path file = written(
      "own.toml", "inherits = \"base.toml\"\n[plan]\nkind = \"hexagonal\"\nhexagonal.rows = 2\n");
  const Scenario scenario = scenario_of(file);
  EXPECT_EQ(scenario.plan.kind(), "hexagonal");
  const Setting alone = resolved_scenario(
      scenario_of(written("alone.toml", "[plan]\nkind = \"hexagonal\"\nhexagonal.rows = 2\n")));
  EXPECT_EQ(to_toml(*resolved_scenario(scenario).find_path("plan.hexagonal")),
            to_toml(*alone.find_path("plan.hexagonal")));
}

TEST_F(Inherits, FilesStayRelativeToTheFileThatNamesThem) {
  written("base/starts.csv", "name,x_m,y_m\na,0,0\nb,30,0\n");
  written("base/base.toml",
          "[swarm]\nstart.kind = \"file\"\nstart.file.path = \"starts.csv\"\n"
          "[plan]\nkind = \"square\"\nsquare = { rows = 1, columns = 2 }\n");
  const Scenario scenario = scenario_of(written("own.toml", "inherits = \"base/base.toml\"\n"));
  const Setting whole = resolved_scenario(scenario);
  const auto& path = std::get<std::string>(whole.find_path("swarm.start.file.path")->value);
  EXPECT_EQ(fs::canonical(path), fs::canonical(folder_.path() / "base/starts.csv"));
  EXPECT_EQ(whole.find(inherits_key), nullptr);
}

TEST_F(Inherits, ErrorsNameTheFileAndLineOfWhatIsWrong) {
  const fs::path base = written("base.toml", "[ping]\n\nperoid_s = 3\n");
  const fs::path own = written("own.toml", "inherits = \"base.toml\"\n");
  EXPECT_EQ(complaint(own), fs::canonical(base).string() +
                                ":3: ping has no option \"peroid_s\"; did you mean \"period_s\"?");
  const fs::path both = written("both.toml", "inherits = \"slip.toml\"\n\n[trial]\ntick_s = 0.3\n");
  written("slip.toml", "[guidance.drift]\nperiod_s = 0.25\n");
  EXPECT_NE(complaint(both).find("slip.toml:2: guidance.drift.period_s"), std::string::npos)
      << complaint(both);
}

TEST_F(Inherits, UnknownNamesHaveNearMisses) {
  const auto starts = [](const std::string& text, const std::string& with) {
    EXPECT_TRUE(text.starts_with(with)) << text;
  };
  const fs::path wrong = written("wrong.toml", "\ninherits = \"progam\"\n");
  starts(complaint(wrong), wrong.string() +
                               ":2: there is no set or scenario \"progam\" to inherit (a file is "
                               "named with its .toml); did you mean \"program\"?");
  const fs::path absent = written("absent.toml", "inherits = \"./base.toml\"\n");
  starts(complaint(absent), absent.string() + ":1: there is no file ");
  const fs::path number = written("number.toml", "inherits = [\"text\", 3]\n");
  starts(complaint(number), number.string() + ":1: inherits has an integer; it takes");
  const fs::path typo = written("typo.toml", "inherit = \"text\"\n");
  EXPECT_EQ(complaint(typo), typo.string() +
                                 ":1: a scenario has no option \"inherit\"; did you mean "
                                 "\"inherits\"?");
}

TEST_F(Inherits, CirclesAreRefusedAndTwoWaysToOneFileAreNot) {
  const fs::path a = written("a.toml", "inherits = \"b.toml\"\n");
  const fs::path b = written("b.toml", "\ninherits = \"a.toml\"\n");
  const fs::path self = written("self.toml", "inherits = \"self.toml\"\n");
  EXPECT_TRUE(complaint(a).starts_with(fs::canonical(b).string() + ":2: ")) << complaint(a);
  EXPECT_NE(complaint(a).find("would inherit from itself"), std::string::npos);
  EXPECT_NE(complaint(self).find("would inherit from itself"), std::string::npos);
  written("ground.toml", "[ping]\nperiod_s = 4\n");
  written("left.toml", "inherits = \"ground.toml\"\n");
  written("right.toml", "inherits = \"ground.toml\"\n");
  const fs::path top = written("top.toml", "inherits = [\"left.toml\", \"right.toml\"]\n");
  EXPECT_EQ(complaint(top), "");
  EXPECT_EQ(filled(top).files.size(), 3U);
}

TEST_F(Inherits, FilesThatMultiplyAreRefused) {
  written("9.toml", "[ping]\nperiod_s = 4\n");
  for (int i = 8; i >= 0; --i) {
    const std::string next = std::to_string(i + 1) + ".toml";
    written(std::to_string(i) + ".toml", "inherits = [\"" + next + "\", \"" + next + "\"]\n");
  }
  EXPECT_EQ(complaint(folder_.path() / "4.toml"), "");
  const std::string why = complaint(folder_.path() / "0.toml");
  EXPECT_NE(why.find(".toml:1: more than 256 files are inherited in all"), std::string::npos)
      << why;
}

TEST_F(Inherits, ScenariosOfTheLibraryCanBeInherited) {
  const fs::path file =
      written("own.toml", "inherits = \"construction_square\"\n[trial]\nduration_s = 60\n");
  const Scenario scenario = scenario_of(file);
  EXPECT_EQ(scenario.trial.duration_s, 60.0);
  EXPECT_EQ(scenario.plan.kind(), "square");
}

TEST(TomlFiles, ReadsEachFileOnce) {
  const tests::ScratchFolder folder;
  const fs::path file = folder.write("a.toml", "x = 1\n");
  TomlFiles files;
  EXPECT_EQ(to_toml(files.at(file)), "x = 1\n");
  folder.write("a.toml", "x = 2\n");
  EXPECT_EQ(to_toml(files.at(file)), "x = 1\n");
}

}  // namespace
}  // namespace shoal::scenarios
