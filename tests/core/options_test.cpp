#include "shoal/core/options.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/core/option_place.hpp"
#include "shoal/core/registry.hpp"
#include "tests/core/settings.hpp"

namespace shoal {
namespace {

using namespace tests;

class Shape {
 public:
  static constexpr const char* family = "shape";
  static constexpr const char* family_meaning = "something with an area";
  virtual ~Shape() = default;
  virtual double area() const = 0;
};

struct Square : Shape {
  double side_m = 1.0;
  Origin origin;
  static void declare(Options<Square>& o) {
    o.number("side_m", &Square::side_m, "m", above(0), "length of a side");
  }
  double area() const override { return side_m * side_m; }
};

struct Disc : Shape {
  explicit Disc(double r) : radius_m(r) {}
  double area() const override { return std::numbers::pi * radius_m * radius_m; }
  double radius_m;
};

struct DiscOptions {
  double diameter_m = 2.0;
  static void declare(Options<DiscOptions>& o) {
    o.number("diameter_m", &DiscOptions::diameter_m, "m", in(0, 100), "across");
  }
};

const Register<Shape, Square> registered_square{"square", "four sides"};
const Register<Shape, DiscOptions> registered_disc{
    "disc", "no side",
    [](const DiscOptions& o) { return std::make_unique<Disc>(o.diameter_m / 2); }};

enum class Mode { fast, slow };

struct Nested {
  std::int64_t count = 2;
  Origin origin;
  static void declare(Options<Nested>& o) {
    o.integer("count", &Nested::count, "", in(0, 9), "how many");
  }
};

struct Everything {
  double speed_m_s = 0.5;
  std::int64_t steps = 10;
  bool on = false;
  std::string title = "untitled";
  FilePath file;
  std::vector<std::string> names;
  std::vector<Eigen::Vector2d> points;
  Mode mode = Mode::fast;
  Nested nested;
  Choice<Shape> shape{"square"};
  std::vector<double> weights;
  std::vector<Nested> parts;
  std::optional<Nested> extra;
  Setting free;
  NamedNumbers constants = {{"g", 9.81}};

  static void declare(Options<Everything>& o) {
    o.number("speed_m_s", &Everything::speed_m_s, "m/s", in(0, 5), "speed");
    o.integer("steps", &Everything::steps, "", at_least(1), "how many steps");
    o.flag("on", &Everything::on, "whether");
    o.text("title", &Everything::title, "what to call it");
    o.file("file", &Everything::file, "a file");
    o.texts("names", &Everything::names, "names");
    o.points("points", &Everything::points, "places");
    o.word("mode", &Everything::mode, {{"fast", Mode::fast}, {"slow", Mode::slow}}, "how");
    o.table("nested", &Everything::nested, "nested options");
    o.choice("shape", &Everything::shape, "the shape");
    o.numbers("weights", &Everything::weights, "kg", at_least(0), "how heavy");
    o.tables("part", &Everything::parts, "its parts");
    o.table("extra", &Everything::extra, "may be left out");
    o.setting("free", &Everything::free, "anything", "as it was written");
    o.named_numbers("constants", &Everything::constants, "by names of one's own");
  }

  std::optional<std::string> complaint() const {
    if (on && steps == 13) return "13 steps cannot be on; take another number";
    return std::nullopt;
  }
};

Everything reading(const Setting& table) {
  Everything object;
  read(object, table, "");
  return object;
}

std::string complaint(const std::string& path, const Setting& x) {
  return complaint_of([&] { reading(with(path, x)); });
}

TEST(Options, ReadEveryKindOfValue) {
  EXPECT_EQ(reading(with("speed_m_s", value(1.25))).speed_m_s, 1.25);
  EXPECT_EQ(reading(with("speed_m_s", integer(2))).speed_m_s, 2.0);
  EXPECT_EQ(reading(with("steps", integer(1))).steps, 1);
  EXPECT_TRUE(reading(with("on", value(true))).on);
  EXPECT_EQ(reading(with("title", text("x"))).title, "x");
  EXPECT_EQ(reading(with("mode", text("slow"))).mode, Mode::slow);
  EXPECT_EQ(reading(with("nested.count", integer(7))).nested.count, 7);
  EXPECT_EQ(reading(with("names", value(Setting::List{text("a"), text("b")}))).names,
            (std::vector<std::string>{"a", "b"}));
  const Setting pair = value(Setting::List{integer(1), value(-2.5)});
  const auto points = reading(with("points", value(Setting::List{pair}))).points;
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], Eigen::Vector2d(1, -2.5));
}

TEST(Options, ReadNumbersUnderNamesOfOnesOwn) {
  EXPECT_EQ(reading(Setting{}).constants, (NamedNumbers{{"g", 9.81}}));
  Setting table;
  assign(table, "constants.b", value(2.5));
  assign(table, "constants.a", integer(1));
  const Everything read_back = reading(table);
  EXPECT_EQ(read_back.constants, (NamedNumbers{{"b", 2.5}, {"a", 1.0}}));
  const Setting written = write_options(schema_of<Everything>(), &read_back);
  EXPECT_EQ(reading(written).constants, read_back.constants);

  EXPECT_EQ(complaint("constants", value(3.0)),
            "dir/s.toml:4: constants is a number; it takes a table of numbers");
  EXPECT_EQ(complaint("constants.c", text("x")),
            "dir/s.toml:4: constants.c is a string (\"x\"); it takes a number");
  EXPECT_EQ(complaint("constants.c", value(NAN)),
            "dir/s.toml:4: constants.c is nan; it takes any finite number");

  const OptionPlace place = locate(schema_of<Everything>(), "constants.c");
  EXPECT_EQ(place.key, "constants.c");
  EXPECT_EQ(place.option->type, "a number");
  EXPECT_EQ(place.fallback, nullptr);
  EXPECT_THROW(locate(schema_of<Everything>(), "constants.c.d"), InputError);
}

TEST(Options, KnowWhetherATableWasLeftOut) {
  const Everything without = reading(Setting{});
  EXPECT_FALSE(without.extra);
  EXPECT_EQ(write_options(schema_of<Everything>(), &without).find("extra"), nullptr);
  EXPECT_NE(schema_of<Everything>().defaults.find_path("extra.count"), nullptr);
  EXPECT_EQ(reading(with("extra", Setting{})).extra->count, 2) << "empty, and yet given";

  const Everything given = reading(with("extra.count", integer(5)));
  EXPECT_EQ(given.extra->count, 5);
  EXPECT_EQ(reading(write_options(schema_of<Everything>(), &given)).extra->count, 5);
  EXPECT_NE(complaint("extra.count", integer(10)).find("extra.count is 10"), std::string::npos);
}

TEST(Options, ReadListsOfNumbersAndOfTables) {
  const Setting weights = value(Setting::List{integer(1), value(2.5)});
  EXPECT_EQ(reading(with("weights", weights)).weights, (std::vector<double>{1.0, 2.5}));
  const Setting parts = value(Setting::List{with("count", integer(3)), Setting{}});
  const Everything read_back = reading(with("part", parts));
  ASSERT_EQ(read_back.parts.size(), 2u);
  EXPECT_EQ(read_back.parts[0].count, 3);
  EXPECT_EQ(read_back.parts[1].count, 2);
  EXPECT_EQ(reading(with("free.x", integer(7))).free.find("x")->origin.line, 4);

  EXPECT_EQ(complaint("weights", value(Setting::List{integer(-1)})),
            "dir/s.toml:4: weights is -1; it takes at least 0 kg");
  EXPECT_EQ(complaint("weights", integer(1)),
            "dir/s.toml:4: weights is an integer; it takes a list of numbers in kg");
  EXPECT_EQ(complaint("part", Setting{Setting::Table{}, {"dir/s.toml", 4}}),
            "dir/s.toml:4: part is a table; it takes a list of tables");
  EXPECT_EQ(complaint("part", value(Setting::List{with("count", integer(10))})),
            "dir/s.toml:4: part.count is 10; it takes from 0 to 9");
}

TEST(Options, AreFoundByTheirDottedKeys) {
  const Schema& schema = schema_of<Everything>();
  EXPECT_EQ(locate(schema, "nested.count").option->meaning, "how many");
  EXPECT_EQ(locate(schema, "shape.disc.diameter_m").option->unit, "m");
  EXPECT_EQ(locate(schema, "shape.disc").member->name, "disc");
  EXPECT_TRUE(locate(schema, "shape.kind").is_kind);
  const auto wrong = [&](const char* key) {
    return complaint_of([&] { locate(schema, key, {"dir/s.toml", 4}); });
  };
  EXPECT_EQ(wrong("nestd"),
            "dir/s.toml:4: a scenario has no option \"nestd\"; did you mean \"nested\"?");
  EXPECT_EQ(wrong("shape.dic.diameter_m"),
            "dir/s.toml:4: shape: there is no shape \"dic\"; did you mean \"disc\"?");
  EXPECT_EQ(wrong("steps.x"), "dir/s.toml:4: steps is an integer, so it has no \"x\"");
}

TEST(Options, KeepTheirDefaultsUnlessTheyAreSet) {
  const Everything fresh = reading(Setting{});
  EXPECT_EQ(fresh.speed_m_s, 0.5);
  EXPECT_EQ(fresh.shape.make()->area(), 1.0);
}

TEST(Options, NameAnUnknownKeyItsLineAndTheLikelyOne) {
  EXPECT_EQ(complaint("speed_ms", integer(1)),
            "dir/s.toml:4: a scenario has no option \"speed_ms\"; did you mean \"speed_m_s\"?");
  EXPECT_EQ(complaint("nested.coun", integer(1)),
            "dir/s.toml:4: nested has no option \"coun\"; did you mean \"count\"?");
  EXPECT_EQ(complaint("nested.zzzzzzz", integer(1)),
            "dir/s.toml:4: nested has no option \"zzzzzzz\"; known are count");
}

TEST(Options, RefuseNumbersOutOfRangeAndNumbersThatAreNone) {
  EXPECT_EQ(complaint("speed_m_s", value(5.5)),
            "dir/s.toml:4: speed_m_s is 5.5; it takes from 0 to 5 m/s");
  EXPECT_EQ(complaint("speed_m_s", value(std::nan(""))),
            "dir/s.toml:4: speed_m_s is nan; it takes from 0 to 5 m/s");
  EXPECT_EQ(complaint("steps", integer(0)), "dir/s.toml:4: steps is 0; it takes at least 1");
  EXPECT_EQ(complaint("shape.square.side_m", integer(0)),
            "dir/s.toml:4: shape.square.side_m is 0; it takes above 0 m");
  EXPECT_NE(complaint("shape.square.side_m", value(HUGE_VAL)), "");
  EXPECT_NE(complaint("speed_m_s", value(-HUGE_VAL)), "");
  const Setting bad_pair = value(Setting::List{value(std::nan("")), integer(0)});
  EXPECT_NE(complaint("points", value(Setting::List{bad_pair})), "");
  EXPECT_EQ(complaint("speed_m_s", integer(0)), "");
  EXPECT_EQ(complaint("speed_m_s", integer(5)), "");
}

TEST(Options, RefuseTheWrongType) {
  EXPECT_EQ(complaint("speed_m_s", text("1")),
            "dir/s.toml:4: speed_m_s is a string (\"1\"); it takes a number in m/s");
  EXPECT_EQ(complaint("steps", value(2.0)), "dir/s.toml:4: steps is a number; it takes an integer");
  EXPECT_EQ(complaint("on", integer(1)), "dir/s.toml:4: on is an integer; it takes true or false");
  EXPECT_EQ(complaint("title", value(true)),
            "dir/s.toml:4: title is true or false; it takes a string");
  EXPECT_EQ(complaint("nested", integer(3)),
            "dir/s.toml:4: nested is an integer; it takes a table of options");
  EXPECT_NE(complaint("names", text("a")), "");
  EXPECT_NE(complaint("names", value(Setting::List{integer(1)})), "");
  EXPECT_NE(complaint("points", value(Setting::List{integer(1), integer(2)})), "");
  EXPECT_NE(complaint("file", integer(1)), "");
  EXPECT_NE(complaint("speed_m_s", Setting{}), "");
}

TEST(Options, RefuseAWordThatIsNone) {
  EXPECT_EQ(complaint("mode", text("slw")),
            "dir/s.toml:4: mode has no value \"slw\"; did you mean \"slow\"?");
  EXPECT_NE(complaint("mode", integer(1)), "");
}

TEST(Options, LetTheStructComplainOfValuesThatDoNotGoTogether) {
  Setting table = with("on", value(true));
  assign(table, "steps", integer(13));
  EXPECT_EQ(complaint_of([&] { reading(table); }),
            "dir/s.toml:1: 13 steps cannot be on; take another number");
}

TEST(Options, PutAFileBesideTheFileThatNamesIt) {
  const FilePath beside = reading(with("file", text("x.nc"))).file;
  EXPECT_EQ(beside.path, std::filesystem::current_path() / "dir/x.nc");
  EXPECT_EQ(beside.origin.line, 4);
  Setting from_command_line = text("x.nc");
  from_command_line.origin = {"--set file=x.nc", 0};
  EXPECT_EQ(reading(with("file", from_command_line)).file.path,
            std::filesystem::current_path() / "x.nc");
  EXPECT_EQ(reading(with("file", text("/a/../b.nc"))).file.path, "/b.nc");
  EXPECT_EQ(reading(with("file", text("library:x.nc"))).file.path, "library:x.nc");
}

TEST(Options, TellAStructWhereItWasWritten) {
  Setting table = with("nested.count", integer(1));
  table.find("nested")->origin = {"dir/s.toml", 3};
  EXPECT_EQ(reading(table).nested.origin.line, 3);
}

TEST(Options, WriteWhatTheyRead) {
  Setting table = with("speed_m_s", value(0.1));
  assign(table, "mode", text("slow"));
  assign(table, "nested.count", integer(7));
  assign(table, "shape.kind", text("disc"));
  assign(table, "shape.square.side_m", value(3.0));
  const Everything once = reading(table);
  const Setting written = write_options(schema_of<Everything>(), &once);
  const Everything twice = reading(written);
  EXPECT_EQ(to_toml(write_options(schema_of<Everything>(), &twice)), to_toml(written));
  EXPECT_EQ(twice.nested.count, 7);
  EXPECT_EQ(twice.shape.kind(), "disc");
  // Defaults of the chosen kind are written too, and what was given for the other.
  EXPECT_EQ(std::get<double>(written.find("shape")->find("disc")->find("diameter_m")->value), 2.0);
  EXPECT_EQ(std::get<double>(written.find("shape")->find("square")->find("side_m")->value), 3.0);
}

TEST(Options, DescribeThemselves) {
  const Schema& schema = schema_of<Everything>();
  EXPECT_EQ(schema.options.size(), 15u);
  EXPECT_EQ(schema.find("speed_m_s")->unit, "m/s");
  EXPECT_EQ(schema.find("mode")->type, "one of \"fast\", \"slow\"");
  EXPECT_EQ(schema.find("nested")->table, &schema_of<Nested>());
  EXPECT_EQ(schema.find("shape")->choice->family(), "shape");
  EXPECT_EQ(std::get<double>(schema.defaults.find("speed_m_s")->value), 0.5);
  EXPECT_EQ(schema.find("none"), nullptr);
}

// Choices and the registry ----------------------------------------------------------------------

TEST(Choice, MakesTheKindWithTheOptionsOfItsOwnTable) {
  Setting table = with("shape.square.side_m", value(3.0));
  assign(table, "shape.disc.diameter_m", value(4.0));
  EXPECT_EQ(reading(table).shape.make()->area(), 9.0);
  assign(table, "shape.kind", text("disc"));
  EXPECT_DOUBLE_EQ(reading(table).shape.make()->area(), 4.0 * std::numbers::pi);
}

TEST(Choice, RefusesUnknownKindsAndStrayKeys) {
  EXPECT_EQ(complaint("shape.kind", text("squre")),
            "dir/s.toml:4: shape.kind: there is no shape \"squre\"; did you mean \"square\"?");
  EXPECT_EQ(complaint("shape.side_m", value(3.0)),
            "dir/s.toml:4: shape has no option \"side_m\"; known are disc, square and kind");
  EXPECT_EQ(complaint("shape.kind", integer(1)),
            "dir/s.toml:4: shape.kind is an integer; it takes a string");
  EXPECT_EQ(complaint("shape", text("disc")),
            "dir/s.toml:4: shape is a string; it takes a table: shape.kind = \"...\"");
}

TEST(Choice, ChecksTheTablesOfOtherKindsToo) {
  EXPECT_EQ(complaint("shape.disc.diameter_m", integer(101)),
            "dir/s.toml:4: shape.disc.diameter_m is 101; it takes from 0 to 100 m");
  EXPECT_EQ(complaint("shape.disc.diametr_m", integer(1)),
            "dir/s.toml:4: shape.disc has no option \"diametr_m\"; did you mean \"diameter_m\"?");
  EXPECT_NE(complaint("shape.disc", integer(1)), "");
}

TEST(Choice, AKindWithoutATableKnowsWhereItWasChosen) {
  const auto made = reading(with("shape.kind", text("square"))).shape.make();
  EXPECT_EQ(dynamic_cast<const Square&>(*made).origin.line, 4);
}

// Members that are all in use -------------------------------------------------------------------

struct AllShapes {
  MemberOptions shapes;
  static void declare(Options<AllShapes>& o) {
    o.members("shape", &AllShapes::shapes, Registry<Shape>::instance(), "options of shapes");
  }
};

AllShapes all_shapes(const Setting& table) {
  AllShapes object;
  read(object, table, "");
  return object;
}

TEST(Members, EachTakeTheTableOfTheirName) {
  const AllShapes made = all_shapes(with("shape.disc.diameter_m", value(4.0)));
  const auto& registry = Registry<Shape>::instance();
  EXPECT_DOUBLE_EQ(registry.make("disc", made.shapes.of("disc"), "shape.disc")->area(),
                   4.0 * std::numbers::pi);
  EXPECT_EQ(registry.make("square", made.shapes.of("square"), "shape.square")->area(), 1.0);
}

TEST(Members, AreWrittenCompleteIfSomethingWasGiven) {
  const Schema& schema = schema_of<AllShapes>();
  const AllShapes none;
  EXPECT_TRUE(write_options(schema, &none).table().empty());
  const AllShapes made = all_shapes(with("shape.square", Setting{}));
  const Setting written = write_options(schema, &made);
  EXPECT_EQ(written.find_path("shape.disc"), nullptr);
  EXPECT_EQ(std::get<double>(written.find_path("shape.square.side_m")->value), 1.0);
}

TEST(Members, AreNotChosen) {
  const auto said = [](const std::string& path, const Setting& x) {
    return complaint_of([&] { all_shapes(with(path, x)); });
  };
  EXPECT_EQ(said("shape.kind", text("disc")),
            "dir/s.toml:4: shape has no option \"kind\"; known are disc and square");
  EXPECT_EQ(said("shape.disk.diameter_m", value(1.0)),
            "dir/s.toml:4: shape has no option \"disk\"; did you mean \"disc\"?");
  EXPECT_EQ(said("shape.disc.diameter_m", integer(101)),
            "dir/s.toml:4: shape.disc.diameter_m is 101; it takes from 0 to 100 m");
  EXPECT_EQ(said("shape", text("disc")),
            "dir/s.toml:4: shape is a string; it takes a table with a table for each member");
}

TEST(Registry, KeepsItsMembersSortedAndEveryFamilyKnown) {
  const auto& shapes = Registry<Shape>::instance();
  EXPECT_EQ(shapes.names(), (std::vector<std::string>{"disc", "square"}));
  EXPECT_EQ(shapes.members()[0].summary, "no side");
  EXPECT_EQ(shapes.members()[0].schema().names(), std::vector<std::string>{"diameter_m"});
  EXPECT_EQ(std::ranges::count(families(), "shape", &RegistryBase::family), 1);
  EXPECT_EQ(shapes.make("square", Setting{}, "shape")->area(), 1.0);
  EXPECT_NE(complaint_of([&] { shapes.make("cube", Setting{}, "shape"); }), "");
}

TEST(Registry, RefusesASecondMemberOfTheSameName) {
  using SquareAgain = Register<Shape, Square>;
  EXPECT_THROW((SquareAgain{"square", "again"}), std::logic_error);
  EXPECT_EQ(Registry<Shape>::instance().names().size(), 2u);
}

}  // namespace
}  // namespace shoal
