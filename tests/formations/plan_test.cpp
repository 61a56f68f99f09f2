#include "shoal/formations/plan.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "shoal/core/text.hpp"
#include "tests/support/complaint_of.hpp"
#include "tests/support/shared_data.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;
using shoal::tests::complaint_of;

Setting table(std::initializer_list<std::pair<std::string, Setting>> entries) {
  Setting setting;
  setting.origin = {"scenario.toml", 7};
  for (const auto& [name, value] : entries) {
    setting.at_or_new(name) = value;
    setting.at_or_new(name).origin = {"scenario.toml", 8};
  }
  return setting;
}

template <class T>
Setting value(T x) {
  Setting setting;
  setting.value = x;
  return setting;
}

std::unique_ptr<PlanSource> source(const std::string& kind, const Setting& options) {
  return Registry<PlanSource>::instance().make(kind, options, "plan." + kind);
}

std::unique_ptr<PlanSource> lattice(const std::string& kind, int rows, int columns,
                                    double separation_m) {
  return source(kind, table({{"rows", value(std::int64_t{rows})},
                             {"columns", value(std::int64_t{columns})},
                             {"separation_m", value(separation_m)}}));
}

Plan nodes(const std::vector<std::string>& texts) {
  Setting::List list;
  for (const std::string& text : texts) list.push_back(value(text));
  return source("nodes", table({{"nodes", value(list)}}))->plan();
}

Vector2d mean(const Plan& plan) {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& slot : plan.slots()) sum += slot;
  return sum / plan.size();
}

void expect_congruent(const Plan& plan, const Plan& other, double tolerance_m) {
  ASSERT_EQ(plan.size(), other.size());
  for (int i = 0; i < plan.size(); ++i) {
    const Vector2d expected = other.slot(other.index_of(plan.name(i)));
    EXPECT_LT((plan.slot(i) - expected).norm(), tolerance_m) << plan.name(i);
  }
}

// The plan object -------------------------------------------------------------------------------

TEST(Plan, FindsEverySlotByItsName) {
  const Plan plan({"b", "c", "a"}, {{0, 0}, {1, 0}, {2, 0}});
  for (int i = 0; i < plan.size(); ++i) EXPECT_EQ(plan.index_of(plan.name(i)), i);
}

TEST(Plan, NamesTheMissingSlotAndTheKnownOnes) {
  const Plan plan({"b", "c", "a"}, {{0, 0}, {1, 0}, {2, 0}});
  EXPECT_EQ(complaint_of([&] {
              plan.index_of("NODE_9", {"s.toml", 3});
            }),
            "s.toml:3: the plan has no slot named \"NODE_9\"; it has b, c and a");
  const Plan big = lattice("square", 20, 20, 300)->plan();
  const std::string long_one = complaint_of([&] { big.index_of("x"); });
  EXPECT_NE(long_one.find("NODE_24 and 376 more"), std::string::npos) << long_one;
}

TEST(Plan, RefusesDuplicateNamesCoincidentSlotsAndNoSlots) {
  const Origin here{"p.toml", 2};
  EXPECT_EQ(complaint_of([&] {
              Plan({"a", "b", "a"}, {{0, 0}, {1, 0}, {2, 0}}, here);
            }),
            "p.toml:2: the plan has two slots named a; every vehicle needs one slot of its own");
  EXPECT_EQ(complaint_of([&] {
              Plan({"a", "b", "c"}, {{5, 0}, {1, 0}, {5, 0.0009}}, here);
            }),
            "p.toml:2: slots a and c of the plan are at the same place, (5, 0) m; move one of "
            "them");
  EXPECT_NE(complaint_of([&] { Plan({}, {}, here); }), "");
  EXPECT_NE(complaint_of([&] { Plan({"a"}, {}, here); }), "");
  EXPECT_NE(complaint_of([&] { Plan({""}, {{0, 0}}, here); }), "");
  EXPECT_EQ(complaint_of([&] { Plan({"a", "b"}, {{0, 0}, {0.0011, 0}}, here); }), "");
}

TEST(Plan, RefusesSlotsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vector2d& slot : {Vector2d(nan, 0), Vector2d(0, nan), Vector2d(-inf, 0)}) {
    EXPECT_NE(complaint_of([&] { Plan({"a"}, {slot}); }), "");
  }
}

TEST(Plan, RefusesSlotsThatAreNotOnThisEarth) {
  EXPECT_EQ(complaint_of([] { Plan({"a", "b"}, {{1e7, 0}, {0, -1e7}}); }), "");
  EXPECT_EQ(complaint_of([] {
              Plan({"a", "b"}, {{1e300, 0}, {0, 0}});
            }),
            "slot a of the plan is at (1e+300, 0) m; give it coordinates of at most 1e+07 m");
}

TEST(Plan, CentredHasItsMeanAtTheOriginAndTheSameShape) {
  const Plan plan = Plan({"a", "b", "c"}, {{100, 7}, {101, 7}, {102, 10}}).centred();
  EXPECT_LT(mean(plan).norm(), 1e-12);
  EXPECT_LT((plan.slot(2) - plan.slot(0) - Vector2d(2, 3)).norm(), 1e-12);
}

// Lattices and letters --------------------------------------------------------------------------

TEST(SquarePlan, RefusesMoreSlotsThanThereAreToBe) {
  const auto complaint = [](std::int64_t rows, int layers) {
    const auto square =
        source("square", table({{"rows", value(rows)}, {"columns", value(std::int64_t{400})}}));
    return complaint_of([&] { square->padded(layers); });
  };
  EXPECT_EQ(complaint(250, 0), "");
  EXPECT_NE(complaint(251, 0).find("a lattice of 251 x 400 has 100400 slots, and may have 100000; "
                                   "take fewer rows, columns or layers"),
            std::string::npos);
  EXPECT_NE(complaint(1, 1000000000), "");
}

TEST(SquarePlan, NumbersColumnByColumnWithRowsRunningSouth) {
  const Plan plan = source("square", table({}))->plan();
  ASSERT_EQ(plan.size(), 20);
  EXPECT_LT(mean(plan).norm(), 1e-9);
  EXPECT_EQ(plan.name(0), "NODE_1");
  EXPECT_EQ(plan.name(19), "NODE_20");
  const Vector2d corner = plan.slot(plan.index_of("NODE_1"));
  EXPECT_LT((plan.slot(plan.index_of("NODE_2")) - corner - Vector2d(0, -300)).norm(), 1e-9);
  EXPECT_LT((plan.slot(plan.index_of("NODE_6")) - corner - Vector2d(300, 0)).norm(), 1e-9);
}

TEST(HexagonalPlan, PutsEveryNearestNeighbourAtTheSeparation) {
  const Plan plan = lattice("hexagonal", 4, 5, 200)->plan();
  ASSERT_EQ(plan.size(), 20);
  EXPECT_LT(mean(plan).norm(), 1e-9);
  for (int i = 0; i < plan.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int j = 0; j < plan.size(); ++j) {
      if (j != i) nearest = std::min(nearest, (plan.slot(i) - plan.slot(j)).norm());
    }
    EXPECT_NEAR(nearest, 200.0, 1e-9) << plan.name(i);
  }
}

TEST(LatticePlan, PaddingAddsALayerOnEverySide) {
  for (const char* kind : {"square", "hexagonal"}) {
    const auto bare = lattice(kind, 5, 4, 300);
    EXPECT_EQ(bare->padded(0).size(), 20);
    EXPECT_EQ(bare->padded(1).size(), 42);
    EXPECT_EQ(bare->padded(2).size(), 72);
    for (const int layers : {-1, most_layers + 1}) {
      EXPECT_NE(complaint_of([&] { bare->padded(layers); }).find("give 0 to 100"),
                std::string::npos);
    }
  }
}

TEST(LatticePlan, OneSlotIsALattice) {
  const Plan plan = lattice("hexagonal", 1, 1, 300)->plan();
  ASSERT_EQ(plan.size(), 1);
  EXPECT_EQ(plan.slot(0), Vector2d::Zero());
}

TEST(LatticePlan, RefusesImpossibleSizes) {
  EXPECT_EQ(complaint_of([] { lattice("square", 0, 4, 300); }),
            "scenario.toml:8: plan.square.rows is 0; it takes from 1 to 1000");
  EXPECT_NE(complaint_of([] { lattice("square", 5, 1001, 300); }), "");
  EXPECT_NE(complaint_of([] { lattice("square", 5, 4, 0); }), "");
  EXPECT_NE(complaint_of([] { lattice("square", 5, 4, -300); }), "");
  const std::string tiny = complaint_of([] { lattice("square", 5, 4, 1e-6)->plan(); });
  EXPECT_NE(tiny.find("scenario.toml:7: slots NODE_1 and NODE_2"), std::string::npos) << tiny;
}

TEST(LettersPlan, ScalesWithTheOption) {
  const Plan plain = source("letters", table({}))->plan();
  const Plan twice = source("letters", table({{"scale", value(2.0)}}))->plan();
  ASSERT_EQ(plain.size(), 22);
  EXPECT_LT(mean(plain).norm(), 1e-9);
  for (int i = 0; i < plain.size(); ++i) {
    EXPECT_LT((twice.slot(i) - 2.0 * plain.slot(i)).norm(), 1e-9);
  }
  EXPECT_EQ(source("letters", table({}))->padded(1).size(), 22);
  EXPECT_NE(complaint_of([] { source("letters", table({{"scale", value(0.0)}})); }), "");
}

/// The plans of the public data set: name -> plan.
std::map<std::string, Plan> public_plans(const std::filesystem::path& path) {
  std::map<std::string, std::pair<std::vector<std::string>, std::vector<Vector2d>>> read;
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto fields = split(trimmed(line), ',');
    auto& [names, slots] = read[std::string(fields.at(0))];
    names.emplace_back(fields.at(2));
    slots.emplace_back(*parsed_number(fields.at(3)), *parsed_number(fields.at(4)));
  }
  std::map<std::string, Plan> plans;
  for (const auto& [name, plan] : read) {
    plans.emplace(name, Plan(plan.first, plan.second).centred());
  }
  return plans;
}

TEST(PlanSources, AreThePlansOfTheThesisTrials) {
  const auto path = shoal::tests::shared_data("formation_plans.csv");
  SHOAL_NEEDS_SHARED(path);
  const auto plans = public_plans(path);
  const double rounding_m = 2e-6;
  const auto square = lattice("square", 5, 4, 300);
  expect_congruent(square->plan(), plans.at("square_4x5"), rounding_m);
  expect_congruent(square->padded(1), plans.at("square_4x5_metric_6x7"), rounding_m);
  const auto five = lattice("hexagonal", 5, 5, 300);
  expect_congruent(five->plan(), plans.at("hex_5x5"), rounding_m);
  expect_congruent(five->padded(1), plans.at("hex_5x5_metric_7x7"), rounding_m);
  const auto wide = lattice("hexagonal", 4, 5, 300);
  expect_congruent(wide->plan(), plans.at("hex_nx5_ny4"), rounding_m);
  expect_congruent(wide->padded(1), plans.at("hex_nx5_ny4_metric_7x6"), rounding_m);
  const auto high = lattice("hexagonal", 5, 4, 300);
  expect_congruent(high->plan(), plans.at("hex_nx4_ny5"), rounding_m);
  expect_congruent(high->padded(1), plans.at("hex_nx4_ny5_metric_6x7"), rounding_m);
  const auto letters = source("letters", table({}));
  expect_congruent(letters->plan(), plans.at("letters_NR"), rounding_m);
  expect_congruent(letters->padded(1), plans.at("letters_NR_metric"), rounding_m);
}

// The thesis' own strings -----------------------------------------------------------------------

TEST(NodesPlan, ReadsTheFormOfTheThesisInAnyOrderAndSpacing) {
  const Plan plan =
      nodes({"name = NODE_1, x = 0, y = 300", "y=-1e2,name=NODE 2,x=+20.5", "x = 4,y = 5 ,name=c"});
  ASSERT_EQ(plan.size(), 3);
  EXPECT_LT(mean(plan).norm(), 1e-12);
  const Vector2d between = plan.slot(plan.index_of("NODE 2")) - plan.slot(plan.index_of("NODE_1"));
  EXPECT_LT((between - Vector2d(20.5, -400)).norm(), 1e-12);
}

TEST(NodesPlan, NamesTheOffendingStringAndWhereItWasWritten) {
  const std::string good = "name = a, x = 0, y = 0";
  const auto expect = [&](const std::string& bad, const std::string& what) {
    EXPECT_EQ(complaint_of([&] {
                nodes({good, bad});
              }),
              "scenario.toml:7: in the node \"" + bad + "\": " + what);
  };
  expect("name = b, x = 1", "y is missing");
  expect("x = 1, y = 1", "name is missing");
  expect("name = b, x = one, y = 1", "x is \"one\"; it takes a finite number of metres");
  expect("name = b, x = nan, y = 1", "x is \"nan\"; it takes a finite number of metres");
  expect("name = b, x = 1 m, y = 1", "x is \"1 m\"; it takes a finite number of metres");
  expect("name = b, x = 1, y = 1, y = 2", "y is given twice");
  expect("name = , x = 1, y = 1", "name is empty");
  expect("nam = b, x = 1, y = 1", "there is no key \"nam\"; did you mean \"name\"?");
  EXPECT_NE(complaint_of([&] { nodes({good, ""}); }), "");
  EXPECT_NE(complaint_of([&] { nodes({good, "name = b; x = 1; y = 2"}); }), "");
}

TEST(NodesPlan, NamesBothOfTwoStringsThatClash) {
  EXPECT_EQ(complaint_of([] {
              nodes({"name=a,x=0,y=0", "name=b,x=1,y=0", "name=a,x=2,y=0"});
            }),
            "scenario.toml:7: the nodes \"name=a,x=0,y=0\" and \"name=a,x=2,y=0\" have the same "
            "name; rename one of them");
  EXPECT_EQ(complaint_of([] {
              nodes({"name=a,x=0,y=0", "name=b,x=0,y=0"});
            }),
            "scenario.toml:7: the nodes \"name=a,x=0,y=0\" and \"name=b,x=0,y=0\" are at the same "
            "place; move one of them");
  EXPECT_NE(complaint_of([] { nodes({}); }).find("scenario.toml:7: "), std::string::npos);
}

// Files -----------------------------------------------------------------------------------------

class PlanFromFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("shoal_plan_" + std::to_string(::getpid()) + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Plan plan(const std::string& text) const {
    std::ofstream(folder_ / "plan.csv", std::ios::binary) << text;
    return plan_at(folder_ / "plan.csv");
  }

  static Plan plan_at(const std::filesystem::path& path) {
    return source("file", table({{"path", value(path.string())}}))->plan();
  }

  void expect_complaint(const std::string& text, int line, const std::string& what) const {
    const std::string where =
        (folder_ / "plan.csv").string() + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
    EXPECT_EQ(complaint_of([&] { plan(text); }), where + what);
  }

  std::filesystem::path folder_;
};

TEST_F(PlanFromFile, ReadsColumnsInAnyOrderAndPassesOverBlanksAndComments) {
  const Plan read =
      plan("# made by hand\ny_m, name ,x_m\n\n300,NODE_1,0\n  # pause\n 0 , b, 1e2\n");
  ASSERT_EQ(read.size(), 2);
  EXPECT_LT(mean(read).norm(), 1e-12);
  const Vector2d between = read.slot(read.index_of("b")) - read.slot(read.index_of("NODE_1"));
  EXPECT_LT((between - Vector2d(100, -300)).norm(), 1e-12);
}

TEST_F(PlanFromFile, AcceptsCrlfAByteOrderMarkQuotesAndNoLastNewline) {
  const Plan read =
      plan("\xEF\xBB\xBF\"name\",\"x_m\",\"y_m\"\r\n\"a, \"\"b\"\"\",0,1\r\nc,\"2\",3");
  ASSERT_EQ(read.size(), 2);
  EXPECT_EQ(read.name(0), "a, \"b\"");
}

TEST_F(PlanFromFile, RefusesWhatMayBeARowOrAComment) {
  const std::string header = "name,x_m,y_m\n";
  expect_complaint(header + "#1,0,0\nc,0,100\n", 2,
                   "this may be a row with the name #1, or a comment; quote the name, or put a "
                   "blank after #");
  EXPECT_EQ(plan(header + "\"#1\",0,0\n# 2,5,5\n## 3,6,6\n#four\nc,0,100\n").size(), 2);
}

TEST_F(PlanFromFile, RefusesTextThatIsNotUtf8) {
  const std::string advice = "; save the file as UTF-8 (from Latin-1: iconv -f latin1 -t utf8)";
  expect_complaint("name,x_m,y_m\na,0,0\nM\xd6,1,1\n", 3,
                   "byte 2 of this line is not UTF-8" + advice);
  expect_complaint("name,x_m,y_m\n# M\xd6\na,0,0\n", 2,
                   "byte 4 of this line is not UTF-8" + advice);
  EXPECT_EQ(plan("name,x_m,y_m\na,0,0\nM\xc3\x96,1,1\n").name(1), "M\xc3\x96");
}

TEST_F(PlanFromFile, ComplainsOfBadFieldsWithTheirLine) {
  const std::string head = "name,x_m,y_m\n\na,0,0\n";
  expect_complaint(head + "b,one,0\n", 4, "x_m is \"one\"; it takes a finite number");
  expect_complaint(head + "b,1,nan\n", 4, "y_m is \"nan\"; it takes a finite number");
  expect_complaint(head + "b,1,-inf\n", 4, "y_m is \"-inf\"; it takes a finite number");
  expect_complaint(head + "b,1,1e999\n", 4, "y_m is \"1e999\"; it takes a finite number");
  expect_complaint(head + "b,1,\n", 4, "y_m is empty");
  expect_complaint(head + ",1,2\n", 4, "name is empty");
  expect_complaint(head + "b,1\n", 4, "this row has 2 fields; it needs 3: name, x_m and y_m");
  expect_complaint(head + "b,1,2,3\n", 4, "this row has 4 fields; it needs 3: name, x_m and y_m");
  expect_complaint(head + "\"b,1,2\n", 4, "a quoted field does not end; close it with \"");
  expect_complaint(head + "\"b\"c,1,2\n", 4, "\"c\" follows a quoted field; put a comma");
}

TEST_F(PlanFromFile, NamesBothLinesOfSlotsThatClash) {
  const std::string head = "name,x_m,y_m\na,0,0\n# between\n";
  expect_complaint(head + "b,1,1\na,2,2\n", 5,
                   "this slot has the same name \"a\" as that in line 2; change one of them");
  expect_complaint(head + "b,0,0.0005\n", 4,
                   "this slot is at the same place as that in line 2; change one of them");
}

TEST_F(PlanFromFile, ComplainsOfAWrongHeader) {
  expect_complaint("name,x_m\na,0\n", 1,
                   "the column \"y_m\" is missing; the first line names name, x_m and y_m");
  expect_complaint("name,x_m,y\na,0,0\n", 1,
                   "there is no column \"y\" in such a file; did you mean \"y_m\"?");
  expect_complaint("name,x_m,y_m,x_m\na,0,0,0\n", 1, "the column \"x_m\" stands here twice");
}

TEST_F(PlanFromFile, ComplainsOfNothingToRead) {
  expect_complaint("", 0, "the file is empty; its first line names the columns name, x_m and y_m");
  expect_complaint("\n# only a comment\n", 0,
                   "the file is empty; its first line names the columns name, x_m and y_m");
  expect_complaint("name,x_m,y_m\n\n", 0, "the file has no rows below its header");
}

TEST_F(PlanFromFile, PointsAtTheSettingWhenTheFileIsNotThere) {
  const auto absent = folder_ / "absent.csv";
  EXPECT_EQ(complaint_of([&] { plan_at(absent); }),
            "scenario.toml:8: cannot open " + absent.string() + "; is there such a CSV file?");
  EXPECT_EQ(complaint_of([&] { plan_at(folder_); }),
            "scenario.toml:8: " + folder_.string() + " is a directory; name a CSV file");
  EXPECT_EQ(complaint_of([&] { source("file", table({}))->plan(); }),
            "scenario.toml:7: this plan needs a file; set plan.file.path");
  EXPECT_NE(complaint_of([&] {
              source("file", table({{"path", value(std::string("library:x"))}}))->plan();
            }),
            "");
}

}  // namespace
}  // namespace shoal::formations
