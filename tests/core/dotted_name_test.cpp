// Members whose names have dots, and whose options therefore sit in nested tables.

#include <gtest/gtest.h>

#include "shoal/core/registry.hpp"
#include "tests/core/settings.hpp"

namespace shoal {
namespace {

using namespace tests;

/// A family like that of the solvers: two members of one library, one name without a dot, and one
/// that chooses from its own family.
class Tool {
 public:
  static constexpr const char* family = "tool";
  static constexpr const char* family_meaning = "something to work with";
  virtual ~Tool() = default;
  virtual std::string text() const = 0;
};

class Bit {
 public:
  static constexpr const char* family = "bit";
  static constexpr const char* family_meaning = "what a drill turns";
  virtual ~Bit() = default;
};

struct Saw : Tool {
  std::int64_t teeth = 20;
  static void declare(Options<Saw>& o) {
    o.integer("teeth", &Saw::teeth, "", in(1, 99), "how many");
  }
  std::string text() const override { return std::to_string(teeth) + " teeth"; }
};

struct Knife : Tool {
  static void declare(Options<Knife>&) {}
  std::string text() const override { return "sharp"; }
};

struct Twice : Tool {
  Choice<Tool> first{"hand.saw"};
  static void declare(Options<Twice>& o) { o.choice("first", &Twice::first, "what to use two of"); }
  std::string text() const override {
    const auto one = first.make();
    return one->text() + ", " + one->text();
  }
};

struct Drill : Tool {
  Choice<Bit> bit{"wood"};
  static void declare(Options<Drill>& o) { o.choice("bit", &Drill::bit, "the bit"); }
  std::string text() const override { return bit.kind(); }
};

struct Wood : Bit {
  static void declare(Options<Wood>&) {}
};

struct Unused {
  static constexpr const char* family = "unused";
  static constexpr const char* family_meaning = "chosen nowhere";
};

const Register<Tool, Twice> registered_twice{"both_hands", "the same twice"};
const Register<Tool, Saw> registered_saw{"hand.saw", "cuts"};
const Register<Tool, Saw> registered_fine_saw{"hand.saw_fine", "cuts finely"};
const Register<Tool, Knife> registered_knife{"knife", "cuts too"};
const Register<Tool, Drill> registered_drill{"motor.drill", "turns a bit"};
const Register<Bit, Wood> registered_wood{"wood", "for wood"};

struct Bench {
  Choice<Tool> tool{"knife"};
  static void declare(Options<Bench>& o) { o.choice("tool", &Bench::tool, "the tool"); }
};

struct Workshop {
  Bench bench;
  static void declare(Options<Workshop>& o) { o.table("bench", &Workshop::bench, "where"); }
};

Workshop workshop(const Setting& table) {
  Workshop object;
  read(object, table, "");
  return object;
}

std::string refusal(const std::string& path, const Setting& x) {
  return complaint_of([&] { workshop(with(path, x)); });
}

TEST(DottedName, IsChosenWholeAndReadsItsOptionsFromNestedTables) {
  Setting table = with("bench.tool.kind", text("hand.saw"));
  EXPECT_EQ(workshop(table).bench.tool.make()->text(), "20 teeth");
  assign(table, "bench.tool.hand.saw.teeth", integer(7));
  assign(table, "bench.tool.hand.saw_fine.teeth", integer(90));
  EXPECT_EQ(workshop(table).bench.tool.make()->text(), "7 teeth");
  assign(table, "bench.tool.kind", text("hand.saw_fine"));
  EXPECT_EQ(workshop(table).bench.tool.make()->text(), "90 teeth");
  assign(table, "bench.tool.kind", text("knife"));
  EXPECT_EQ(workshop(table).bench.tool.make()->text(), "sharp");
}

TEST(DottedName, ComplainsUnderTheWholeKey) {
  EXPECT_EQ(refusal("bench.tool.hand.saw.teeth", integer(0)),
            "dir/s.toml:4: bench.tool.hand.saw.teeth is 0; it takes from 1 to 99");
  EXPECT_EQ(refusal("bench.tool.hand.saw.teth", integer(3)),
            "dir/s.toml:4: bench.tool.hand.saw has no option \"teth\"; did you mean \"teeth\"?");
  EXPECT_EQ(refusal("bench.tool.hand.saw", integer(3)),
            "dir/s.toml:4: bench.tool.hand.saw is an integer; it takes a table of options");
  EXPECT_EQ(refusal("bench.tool.hand", integer(3)),
            "dir/s.toml:4: bench.tool.hand is an integer; it takes a table of options");
}

TEST(DottedName, IsSuggestedForOneThatIsWrongInAnyPart) {
  EXPECT_EQ(refusal("bench.tool.hand.swa.teeth", integer(3)),
            "dir/s.toml:4: bench.tool.hand has no option \"swa\"; did you mean \"saw\"?");
  EXPECT_EQ(refusal("bench.tool.hand.axe.teeth", integer(3)),
            "dir/s.toml:4: bench.tool.hand has no option \"axe\"; known are saw and saw_fine");
  EXPECT_EQ(refusal("bench.tool.hand.kind", text("saw")),
            "dir/s.toml:4: bench.tool.hand has no option \"kind\"; known are saw and saw_fine");
  EXPECT_EQ(refusal("bench.tool.moter.drill", integer(3)),
            "dir/s.toml:4: bench.tool has no option \"moter\"; did you mean \"motor\"?");
  EXPECT_EQ(refusal("bench.tool.hand_saw.teeth", integer(3)),
            "dir/s.toml:4: bench.tool has no option \"hand_saw\"; did you mean \"hand.saw\"?");
  EXPECT_EQ(refusal("bench.tool.zzzzzzzzzzzz", integer(3)),
            "dir/s.toml:4: bench.tool has no option \"zzzzzzzzzzzz\"; known are both_hands, "
            "hand.saw, hand.saw_fine, knife, motor.drill and kind");
  EXPECT_EQ(refusal("bench.tool.kind", text("hand.sow")),
            "dir/s.toml:4: bench.tool.kind: there is no tool \"hand.sow\"; did you mean "
            "\"hand.saw\"?");
  EXPECT_EQ(refusal("bench.tool.kind", text("hand")),
            "dir/s.toml:4: bench.tool.kind: there is no tool \"hand\"; did you mean one of "
            "hand.saw and hand.saw_fine?");
}

TEST(DottedName, IsRefusedInQuotesSoThatNoTableHidesAnother) {
  Setting table = with("bench.tool.kind", text("hand.saw"));
  Setting& quoted = table.find_path("bench.tool")->at_or_new("hand.saw");
  quoted.origin = {"dir/s.toml", 5};
  EXPECT_EQ(complaint_of([&] { workshop(table); }),
            "dir/s.toml:5: bench.tool has no option \"hand.saw\"; write bench.tool.hand.saw "
            "without quotes");
}

TEST(DottedName, IsWrittenAsItIsRead) {
  Setting table = with("bench.tool.kind", text("both_hands"));
  assign(table, "bench.tool.both_hands.first.kind", text("hand.saw_fine"));
  assign(table, "bench.tool.both_hands.first.hand.saw_fine.teeth", integer(80));
  assign(table, "bench.tool.hand.saw.teeth", integer(7));
  const Workshop once = workshop(table);
  EXPECT_EQ(once.bench.tool.make()->text(), "80 teeth, 80 teeth");
  const Setting written = write_options(schema_of<Workshop>(), &once);
  EXPECT_EQ(to_toml(written),
            "[bench.tool]\n"
            "kind = \"both_hands\"\n"
            "\n[bench.tool.both_hands.first]\n"
            "kind = \"hand.saw_fine\"\n"
            "\n[bench.tool.both_hands.first.hand.saw_fine]\n"
            "teeth = 80\n"
            "\n[bench.tool.hand.saw]\n"
            "teeth = 7\n");
  const Workshop twice = workshop(written);
  EXPECT_EQ(to_toml(write_options(schema_of<Workshop>(), &twice)), to_toml(written));
  EXPECT_EQ(twice.bench.tool.make()->text(), "80 teeth, 80 teeth");
}

TEST(DottedName, IsRefusedWhereItsOptionsWouldMixWithThoseOfAnother) {
  using SawAgain = Register<Tool, Saw>;
  for (const char* name : {"hand", "hand.saw.large", "knife.x", "motor"}) {
    EXPECT_THROW((SawAgain{name, "again"}), std::logic_error) << name;
  }
  EXPECT_EQ(Registry<Tool>::instance().names().size(), 5u);
}

TEST(Registry, FindsTheKeyOfAFamilyAlsoBelowMembersThatChooseFromTheirOwn) {
  const Schema& root = schema_of<Workshop>();
  EXPECT_EQ(key_of(Registry<Tool>::instance(), root), "bench.tool");
  // `both_hands` comes first and chooses a tool again.
  EXPECT_EQ(key_of(Registry<Bit>::instance(), root), "bench.tool.motor.drill.bit");
  EXPECT_EQ(key_of(Registry<Unused>::instance(), root), "");
}

}  // namespace
}  // namespace shoal
