#include "shoal/core/text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "shoal/core/error.hpp"

namespace shoal {
namespace {

using Words = std::vector<std::string>;

TEST(Text, SuggestsACloseNameAndListsThemWhenNoneIsClose) {
  const Words known{"delta_theta_deg", "ownship_weight"};
  EXPECT_EQ(suggestion("delta_thta_deg", known), "; did you mean \"delta_theta_deg\"?");
  EXPECT_EQ(suggestion("xyz", known), "; known are delta_theta_deg and ownship_weight");
  EXPECT_EQ(suggestion("x", Words{}), "; none is known here");
}

TEST(Text, SuggestsEveryNameThatGoesOnBehindADot) {
  const Words known{"hand.drill", "hand.saw", "handle"};
  EXPECT_EQ(suggestion("hand", known), "; did you mean one of hand.drill and hand.saw?");
  EXPECT_EQ(suggestion("handl", known), "; did you mean \"handle\"?");
}

TEST(Text, ListsWordsAsASentenceDoes) {
  EXPECT_EQ(listed(Words{}), "");
  EXPECT_EQ(listed(Words{"a"}), "a");
  EXPECT_EQ(listed(Words{"a", "b"}), "a and b");
  EXPECT_EQ(listed(Words{"a", "b", "c"}), "a, b and c");
}

TEST(Text, ShortestReadsBackAsTheSameNumber) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(300.0), "300");
  EXPECT_EQ(shortest(-1e-5), "-1e-05");
  EXPECT_TRUE(rc::check(
      "round trip", [](double x) { RC_ASSERT(parsed_number(shortest(x)) == std::optional(x)); }));
  for (const double x : {5e-324, 1.7976931348623157e308, -1.0 / 3.0}) {
    EXPECT_EQ(parsed_number(shortest(x)), x);
  }
}

TEST(Text, ParsesOnlyWholeFiniteNumbers) {
  EXPECT_EQ(parsed_number("+2.5"), 2.5);
  EXPECT_EQ(parsed_number("-1e3"), -1000.0);
  for (const char* wrong :
       {"", " 1", "1 ", "1m", "one", "nan", "inf", "-inf", "1e999", "+", "+-1", "0x10", "1,5"}) {
    EXPECT_EQ(parsed_number(wrong), std::nullopt) << wrong;
  }
}

TEST(Text, OfUtf8IsThatOfRfc3629) {
  for (const char* right : {"", "plain", "M\xc3\xa4rz", "\xe2\x89\xa4", "\xf0\x9f\x90\x9f", "\x7f",
                            "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(first_not_utf8(right), std::nullopt) << right;
  }
  const std::pair<const char*, std::size_t> wrong[]{
      {"M\xd6\x31", 1},         // Latin-1
      {"abc\x80", 3},           // a continuation that continues nothing
      {"\xc3", 0},              // cut off
      {"ab\xe2\x89", 2},        // cut off
      {"\xc0\xaf", 0},          // overlong
      {"\xe0\x9f\xbf", 0},      // overlong
      {"\xf0\x8f\xbf\xbf", 0},  // overlong
      {"\xed\xa0\x80", 0},      // a surrogate
      {"\xf4\x90\x80\x80", 0},  // beyond U+10FFFF
      {"\xc3\xa4\xff", 2}};
  for (const auto& [text, at] : wrong) EXPECT_EQ(first_not_utf8(text), at) << text;
}

TEST(Text, SplitsIntoOnePartMoreThanThereAreSeparators) {
  EXPECT_EQ(split("a,b", ','), (std::vector<std::string_view>{"a", "b"}));
  EXPECT_EQ(split(",a,", ','), (std::vector<std::string_view>{"", "a", ""}));
  EXPECT_EQ(split("", ','), (std::vector<std::string_view>{""}));
}

TEST(Text, TrimsBlanksAndLineEndsOnBothSides) {
  EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Origin, StandsInFrontOfAMessageAsFarAsItIsKnown) {
  EXPECT_STREQ(InputError({"a.toml", 3}, "wrong").what(), "a.toml:3: wrong");
  EXPECT_STREQ(InputError({"--set a=1", 0}, "wrong").what(), "--set a=1: wrong");
  EXPECT_STREQ(InputError(Origin{}, "wrong").what(), "wrong");
}

}  // namespace
}  // namespace shoal
