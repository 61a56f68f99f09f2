#include "shoal/scenarios/toml_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "shoal/core/options.hpp"
#include "tests/core/settings.hpp"

namespace shoal::scenarios {
namespace {

class TomlFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("shoal_toml_" + std::to_string(::getpid()) + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path written(const std::string& text) const {
    const auto path = folder_ / "scenario.toml";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::string complaint(const std::string& text) const { return complaint_of(written(text)); }

  static std::string complaint_of(const std::filesystem::path& path) {
    try {
      read_toml(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

std::string set_complaint(Setting root, const std::string& assignment) {
  try {
    apply_set(root, assignment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Setting& entry(const Setting& root, const std::string& a, const std::string& b) {
  return *root.find(a)->find(b);
}

Setting with_sets(std::initializer_list<std::string> assignments) {
  Setting root;
  for (const std::string& assignment : assignments) apply_set(root, assignment);
  return root;
}

TEST_F(TomlFile, KeepsEveryKindOfValueWithItsLine) {
  const auto path = written(
      "# a comment\n"
      "[trial]\n"
      "seed = 1\n"
      "duration_s = 1.5\n"
      "record = true\n"
      "title = \"drift\"\n"
      "\n"
      "[plan]\n"
      "square = { rows = 5 }\n"
      "points = [\n"
      "  [0, 1],\n"
      "  [2, 3],\n"
      "]\n");
  const Setting root = read_toml(path);
  const Setting& trial = *root.find("trial");
  EXPECT_EQ(std::get<std::int64_t>(trial.find("seed")->value), 1);
  EXPECT_EQ(std::get<double>(trial.find("duration_s")->value), 1.5);
  EXPECT_EQ(std::get<bool>(trial.find("record")->value), true);
  EXPECT_EQ(std::get<std::string>(trial.find("title")->value), "drift");
  EXPECT_EQ(trial.origin.line, 2);
  EXPECT_EQ(trial.find("title")->origin.line, 6);
  EXPECT_EQ(trial.find("title")->origin.file, path.string());
  EXPECT_EQ(entry(root, "plan", "square").find("rows")->origin.line, 9);
  const auto& points = std::get<Setting::List>(entry(root, "plan", "points").value);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].origin.line, 12);
}

TEST_F(TomlFile, KnowsTheLineOfDottedKeysAndOfTablesThatWereNotOpened) {
  const Setting root = read_toml(written("\nvehicle.kind = \"drifter\"\n[a.b]\nc = 1\n"));
  EXPECT_EQ(root.find("vehicle")->origin.line, 2);
  EXPECT_EQ(entry(root, "vehicle", "kind").origin.line, 2);
  EXPECT_EQ(root.find("a")->origin.line, 3);
  EXPECT_EQ(entry(root, "a", "b").find("c")->origin.line, 4);
}

TEST_F(TomlFile, KeepsTheOrderOfWriting) {
  const Setting root = read_toml(written("zebra = 1\nant = 2\n[swarm]\n[current]\n[plan]\n"));
  std::vector<std::string> names;
  for (const auto& [name, value] : root.table()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"zebra", "ant", "swarm", "current", "plan"}));
}

TEST_F(TomlFile, AcceptsAByteOrderMarkCrlfAndNothingAtAll) {
  EXPECT_EQ(read_toml(written("\xEF\xBB\xBF"
                              "a = 1\r\nb = 2\r\n"))
                .table()
                .size(),
            2u);
  EXPECT_TRUE(read_toml(written("")).table().empty());
}

TEST_F(TomlFile, ComplainsOfMalformedTomlWithFileAndLine) {
  const std::string complained = complaint("a = 1\nb = = 2\n");
  EXPECT_NE(complained.find("scenario.toml:2: "), std::string::npos) << complained;
  EXPECT_NE(complaint("a = 1\na = 2\n").find("scenario.toml:2: "), std::string::npos);
  EXPECT_NE(complaint("a = \"open\n").find("scenario.toml:1: "), std::string::npos);
  EXPECT_NE(complaint("a = \"\xff\"\n"), "");
}

TEST_F(TomlFile, RefusesKeysOfTooManyParts) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "a.";
  const std::string why =
      "too.toml:2: a key has more than 100 parts; no option is nested that deep";
  for (const std::string& text : {deep + "b = 1", "[" + deep + "b]", "x = { " + deep + "b = 1 }"}) {
    EXPECT_EQ(tests::complaint_of([&] { parse_toml("y = 1\n" + text, "too.toml"); }), why);
  }
  const std::string dots(300, '.');
  EXPECT_NO_THROW(parse_toml("# " + dots + "\na = \"" + dots + "\" # " + dots + "\nb = \"\"\"x\n" +
                                 dots + "\"\"\"\nc = '" + dots + "'\nd = [1.5, 2.5]",
                             "fine.toml"));
  std::string decimals = "a = [";
  for (int i = 0; i < 300; ++i) decimals += "1.5\n,";
  EXPECT_NO_THROW(parse_toml(decimals + "]", "fine.toml"));
}

TEST_F(TomlFile, RefusesAssignmentsToKeysOfTooManyParts) {
  std::string deep = "a";
  for (int i = 1; i < 60'000; ++i) deep += ".a";
  Setting root;
  const std::string why = tests::complaint_of([&] { apply_set(root, deep + "=1"); });
  EXPECT_NE(why.find("a key has 60000 parts, but no option is nested deeper than 100"),
            std::string::npos)
      << why;
  EXPECT_LT(why.size(), 400u);
  EXPECT_TRUE(root.table().empty());
}

TEST_F(TomlFile, RefusesDatesAndTimesWithTheirLine) {
  for (const char* value : {"2014-12-01", "05:03:20", "2014-12-01T05:03:20Z"}) {
    const std::string complained = complaint("a = 1\nb = " + std::string(value) + "\n");
    EXPECT_NE(complained.find("scenario.toml:2: "), std::string::npos) << complained;
    EXPECT_NE(complained.find("date or time"), std::string::npos) << complained;
  }
}

TEST_F(TomlFile, RefusesTextWithANul) {
  for (const char* line :
       {"name = \"a\\u0000b\"", "names = [\"a\", \"\\u0000\"]", "t = { \"a\\u0000\" = 1 }"}) {
    const std::string complained = complaint("a = 1\n" + std::string(line) + "\n");
    EXPECT_NE(complained.find("scenario.toml:2: a text holds the character NUL (\\u0000)"),
              std::string::npos)
        << complained;
  }
  EXPECT_NE(set_complaint({}, "name=\"a\\u0000b\"").find("NUL"), std::string::npos);
}

TEST_F(TomlFile, RefusesAMissingFileAndADirectoryByName) {
  const auto absent = folder_ / "absent.toml";
  EXPECT_NE(complaint_of(absent).find("absent.toml: "), std::string::npos);
  EXPECT_NE(complaint_of(folder_).find("directory"), std::string::npos);
}

TEST_F(TomlFile, ReadsBackWhatWasWritten) {
  const std::string text =
      "seed = -7\n"
      "rate = 0.1\n"
      "whole = 300.0\n"
      "huge = 1e+300\n"
      "flag = false\n"
      "title = \"a \\\"quoted\\\" \\\\ line\\nand\\ttab\"\n"
      "list = [1, 2.5, \"x\", [true], { a = 1 }]\n"
      "empty = []\n"
      "\"odd key\" = 1\n"
      "[table.inner]\n"
      "x = 1\n"
      "[bare]\n";
  const Setting first = read_toml(written(text));
  const std::string printed = to_toml(first);
  const Setting second = read_toml(written(printed));
  EXPECT_EQ(to_toml(second), printed);
  EXPECT_EQ(std::get<std::string>(second.find("title")->value), "a \"quoted\" \\ line\nand\ttab");
  EXPECT_EQ(std::get<double>(second.find("whole")->value), 300.0);
  EXPECT_EQ(std::get<double>(second.find("rate")->value), 0.1);
  EXPECT_EQ(std::get<std::int64_t>(entry(second, "table", "inner").find("x")->value), 1);
  EXPECT_NE(second.find("bare"), nullptr);
  EXPECT_NE(second.find("odd key"), nullptr);
}

struct Inner {
  std::int64_t count = 3;
  std::vector<std::string> names;

  static void declare(Options<Inner>& o) {
    o.integer("count", &Inner::count, "", in(0, 10), "how many");
    o.texts("names", &Inner::names, "their names");
  }
};

struct Outer {
  double speed_m_s = 0.1;
  bool on = false;
  FilePath file;
  std::vector<Eigen::Vector2d> points;
  Inner inner;

  static void declare(Options<Outer>& o) {
    o.number("speed_m_s", &Outer::speed_m_s, "m/s", above(0), "speed");
    o.flag("on", &Outer::on, "whether it runs");
    o.file("file", &Outer::file, "a file");
    o.points("points", &Outer::points, "places");
    o.table("inner", &Outer::inner, "nested options");
  }
};

TEST_F(TomlFile, CarriesAStructThroughTextUnchanged) {
  Outer outer{
      .speed_m_s = 1.0 / 3.0, .on = true, .file = {"/data/x.nc", {}}, .points = {{1, -2.5}}};
  outer.inner = {.count = 7, .names = {"a", "b \"c\""}};
  Outer back;
  read(back, read_toml(written(to_toml(write_options(schema_of<Outer>(), &outer)))), "");
  EXPECT_EQ(back.speed_m_s, outer.speed_m_s);
  EXPECT_EQ(back.on, true);
  EXPECT_EQ(back.file.path, outer.file.path);
  EXPECT_EQ(back.points, outer.points);
  EXPECT_EQ(back.inner.count, 7);
  EXPECT_EQ(back.inner.names, outer.inner.names);
}

TEST_F(TomlFile, PathsInAFileAreRelativeToItAndPathsInASetToWhereOneStands) {
  Setting root = read_toml(written("file = \"currents/x.nc\"\n"));
  Outer outer;
  read(outer, root, "");
  EXPECT_EQ(outer.file.path, (folder_ / "currents/x.nc").lexically_normal());
  apply_set(root, "file=currents/x.nc");
  read(outer, root, "");
  EXPECT_EQ(outer.file.path, std::filesystem::current_path() / "currents/x.nc");
}

TEST_F(TomlFile, NamesTheLineOfAWrongOption) {
  Outer outer;
  try {
    read(outer, read_toml(written("on = true\n[inner]\n\ncount = 11\n")), "");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scenario.toml:4: inner.count is 11"),
              std::string::npos)
        << error.what();
  }
}

TEST(SetOption, ReadsTheValueAsToml) {
  const Setting root = with_sets({"a=3", "b = 2.5", "c=true", "d=\"3\"", "e=[1, 2]", "f=1e3"});
  EXPECT_EQ(std::get<std::int64_t>(root.find("a")->value), 3);
  EXPECT_EQ(std::get<double>(root.find("b")->value), 2.5);
  EXPECT_EQ(std::get<bool>(root.find("c")->value), true);
  EXPECT_EQ(std::get<std::string>(root.find("d")->value), "3");
  EXPECT_EQ(std::get<Setting::List>(root.find("e")->value).size(), 2u);
  EXPECT_EQ(std::get<double>(root.find("f")->value), 1000.0);
}

TEST(SetOption, TakesWhatIsNoTomlAsText) {
  const Setting root = with_sets({"behaviour.kind=rigid_registration", "f=../a b.nc",
                                  "t=2014-12-01", "e=", "q=a=b", "n=1.2.3", "two=1\nx = 2"});
  EXPECT_EQ(std::get<std::string>(entry(root, "behaviour", "kind").value), "rigid_registration");
  EXPECT_EQ(std::get<std::string>(root.find("f")->value), "../a b.nc");
  EXPECT_EQ(std::get<std::string>(root.find("t")->value), "2014-12-01");
  EXPECT_EQ(std::get<std::string>(root.find("e")->value), "");
  EXPECT_EQ(std::get<std::string>(root.find("q")->value), "a=b");
  EXPECT_EQ(std::get<std::string>(root.find("n")->value), "1.2.3");
  EXPECT_EQ(std::get<std::string>(root.find("two")->value), "1\nx = 2");
}

TEST(SetOption, RefusesABracketOrQuoteThatDoesNotClose) {
  for (const char* assignment : {"a={rows=2", "a=[1, 2", "a=\"text", "a='text"}) {
    const std::string complained = set_complaint({}, assignment);
    EXPECT_EQ(complained.find("--set " + std::string(assignment) + ": not a TOML value"), 0u)
        << complained;
  }
}

TEST(SetOption, ATableReplacesOnlyTheKeysItNames) {
  const Setting root = with_sets({"plan.square={rows=5, columns=4}",
                                  "plan={square={rows=2, separation_m=30.0}, kind=\"square\"}"});
  EXPECT_EQ(std::get<std::int64_t>(entry(root, "plan", "square").find("rows")->value), 2);
  EXPECT_EQ(std::get<std::int64_t>(entry(root, "plan", "square").find("columns")->value), 4);
  EXPECT_EQ(std::get<double>(entry(root, "plan", "square").find("separation_m")->value), 30.0);
  EXPECT_EQ(std::get<std::string>(entry(root, "plan", "kind").value), "square");
}

TEST(SetOption, ALaterOneOverridesAnEarlierOne) {
  const Setting root = with_sets({"trial.seed=1", "trial.seed=2"});
  EXPECT_EQ(std::get<std::int64_t>(entry(root, "trial", "seed").value), 2);
  EXPECT_EQ(root.find("trial")->table().size(), 1u);
  EXPECT_EQ(entry(root, "trial", "seed").origin.prefix(), "--set trial.seed=2: ");
  EXPECT_EQ(root.find("trial")->origin.prefix(), "--set trial.seed=1: ");
}

TEST(SetOption, RefusesWhatIsNoAssignment) {
  EXPECT_EQ(set_complaint({}, "trial.seed"),
            "--set trial.seed: there is no value; write --set KEY=VALUE");
  EXPECT_EQ(set_complaint({}, "=3"), "--set =3: there is no key; write --set KEY=VALUE");
  EXPECT_NE(set_complaint({}, "a..b=3"), "");
  EXPECT_NE(set_complaint({}, ".=3"), "");
  EXPECT_NE(set_complaint(with_sets({"a=1"}), "a.b=3").find("\"a\" is an integer"),
            std::string::npos);
  EXPECT_NE(set_complaint({}, "a={t=2014-12-01}").find("date"), std::string::npos);
}

}  // namespace
}  // namespace shoal::scenarios
