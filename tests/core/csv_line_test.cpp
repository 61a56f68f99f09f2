#include "shoal/core/csv_line.hpp"

#include <gtest/gtest.h>

namespace shoal {
namespace {

std::string line(const std::string& field) {
  return csv_line({field});
}

TEST(CsvLine, QuotesWhatNeedsIt) {
  EXPECT_EQ(csv_line({"a", "", "b c"}), "a,,b c\n");
  EXPECT_EQ(csv_line({"one, \"two\"", "a\nb"}), "\"one, \"\"two\"\"\",\"a\nb\"\n");
}

TEST(CsvLine, MarksWhatASpreadsheetWouldTakeForAFormula) {
  for (const std::string text :
       {"=1+1", "+cmd", "-x", "-", "@sum", " =1", "  @a", "-1+2", "\t=1"}) {
    EXPECT_EQ(line(text), "'" + text + "\n");
  }
  EXPECT_EQ(line("\"=1\""), "\"'\"\"=1\"\"\"\n");
  EXPECT_EQ(line(" \"-a"), "\"' \"\"-a\"\n");
  EXPECT_EQ(line("\n=1"), "\"'\n=1\"\n");
  EXPECT_EQ(line("=a,b"), "\"'=a,b\"\n");
  EXPECT_EQ(line("\ra"), "\"'\ra\"\n");
}

TEST(CsvLine, LeavesNumbersAndOtherTexts) {
  for (const std::string text :
       {"-3.5", "+1e3", "-inf", "-1 2.5 -3", " -3.5", "a=b", "1-2", "'=1", "inf", "x @ y", " a"}) {
    EXPECT_EQ(line(text), text + "\n");
  }
}

}  // namespace
}  // namespace shoal
