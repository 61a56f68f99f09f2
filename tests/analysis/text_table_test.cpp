#include "shoal/analysis/text_table.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

using enum TextTable::Format;

TextTable example() {
  TextTable table({"solver", "time us", "remark"});
  table.add({"nlopt.slsqp", "10.8", "50% of \"all\", or more"});
  table.add({"ceres_x", "-", "a|b & c"});
  return table;
}

TEST(TextTable, AlignsNumbersToTheRightAndTextToTheLeft) {
  EXPECT_EQ(example().print(text),
            "solver       time us  remark\n"
            "nlopt.slsqp     10.8  50% of \"all\", or more\n"
            "ceres_x            -  a|b & c\n");
}

TEST(TextTable, QuotesCommasAndQuotesInCsv) {
  EXPECT_EQ(example().print(csv),
            "solver,time us,remark\n"
            "nlopt.slsqp,10.8,\"50% of \"\"all\"\", or more\"\n"
            "ceres_x,-,a|b & c\n");
}

TEST(TextTable, EscapesBarsInMarkdown) {
  EXPECT_EQ(example().print(markdown),
            "| solver | time us | remark |\n"
            "|---|---:|---|\n"
            "| nlopt.slsqp | 10.8 | 50% of \"all\", or more |\n"
            "| ceres_x | - | a\\|b & c |\n");
}

TEST(TextTable, EscapesWhatLatexWouldTakeForCommands) {
  EXPECT_EQ(example().print(latex),
            "\\begin{tabular}{lrl}\n\\toprule\n"
            "solver & time us & remark \\\\\n\\midrule\n"
            "nlopt.slsqp & 10.8 & 50\\% of \"all\", or more \\\\\n"
            "ceres\\_x & - & a|b \\& c \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
  TextTable table({"x"});
  table.add({"\\~^${}#"});
  EXPECT_NE(table.print(latex).find("\\textbackslash{}\\~{}\\^{}\\$\\{\\}\\#"), std::string::npos);
}

TEST(TextTable, RefusesARowOfAnotherLength) {
  TextTable table({"a", "b"});
  EXPECT_THROW(table.add({"1"}), std::invalid_argument);
}

TEST(TextTable, NamesItsFormatsWhenOneIsUnknown) {
  EXPECT_EQ(table_format("latex"), latex);
  try {
    table_format("latx");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "there is no format \"latx\"; did you mean \"latex\"?");
  }
}

}  // namespace
}  // namespace shoal::analysis
