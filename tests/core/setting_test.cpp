#include "shoal/core/setting.hpp"

#include <gtest/gtest.h>

namespace shoal {
namespace {

template <class T>
Setting setting_of(T x, Origin origin = {}) {
  Setting setting;
  setting.value = x;
  setting.origin = std::move(origin);
  return setting;
}

std::string complaint(Setting root, const std::string& path) {
  try {
    assign(root, path, setting_of(1.0, {"here", 1}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Setting, AssignMakesTheTablesOnTheWay) {
  Setting root;
  assign(root, "a.b.c", setting_of(true, {"--set", 0}));
  assign(root, "a.b.d", setting_of(false));
  assign(root, "a.b.c", setting_of(std::int64_t{3}));
  const Setting* b = root.find("a")->find("b");
  ASSERT_EQ(b->table().size(), 2u);
  EXPECT_EQ(std::get<std::int64_t>(b->find("c")->value), 3);
  EXPECT_EQ(b->origin.file, "--set");
  EXPECT_EQ(root.find("x"), nullptr);
  EXPECT_EQ(b->find("c")->find("x"), nullptr);
}

TEST(Setting, AssignRefusesAPathThroughAValueAndAnEmptyPart) {
  Setting root;
  assign(root, "a.b", setting_of(std::string("text")));
  EXPECT_EQ(complaint(root, "a.b.c.d"), "here:1: \"a.b\" is a string, so it has no \"c\"");
  for (const char* path : {"", ".", "a.", ".a", "a..b"}) {
    EXPECT_NE(complaint(root, path).find("is not a dotted key"), std::string::npos) << path;
  }
}

TEST(Setting, ToTomlPutsValuesBeforeSubTables) {
  Setting root;
  assign(root, "t.inner.x", setting_of(1.0));
  assign(root, "t.y", setting_of(std::int64_t{2}));
  assign(root, "z", setting_of(std::string("q\"\n")));
  assign(root, "l", setting_of(Setting::List{setting_of(0.5), setting_of(true)}));
  EXPECT_EQ(to_toml(root),
            "z = \"q\\\"\\u000a\"\n"
            "l = [0.5, true]\n"
            "\n[t]\n"
            "y = 2\n"
            "\n[t.inner]\n"
            "x = 1.0\n");
}

TEST(Setting, ToTomlWritesListsOfTablesEntryByEntry) {
  Setting first, second, root;
  assign(first, "x", setting_of(1.0));
  assign(first, "set.y", setting_of(std::int64_t{2}));
  assign(second, "x", setting_of(3.0));
  assign(root, "group.step", setting_of(Setting::List{first, second}));
  assign(root, "none", setting_of(Setting::List{}));
  EXPECT_EQ(to_toml(root),
            "none = []\n"
            "\n[[group.step]]\n"
            "x = 1.0\n"
            "\n[group.step.set]\n"
            "y = 2\n"
            "\n[[group.step]]\n"
            "x = 3.0\n");
}

TEST(Setting, SaysWhatAValueIs) {
  EXPECT_EQ(setting_of(true).type_name(), "true or false");
  EXPECT_EQ(setting_of(std::int64_t{1}).type_name(), "an integer");
  EXPECT_EQ(setting_of(1.0).type_name(), "a number");
  EXPECT_EQ(setting_of(std::string()).type_name(), "a string");
  EXPECT_EQ(setting_of(Setting::List{}).type_name(), "a list");
  EXPECT_EQ(Setting{}.type_name(), "a table");
}

}  // namespace
}  // namespace shoal
