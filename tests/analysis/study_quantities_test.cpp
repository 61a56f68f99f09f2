#include <gtest/gtest.h>

#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

/// What is wrong with a study of one scenario that says this, too; "" if nothing.
std::string complaint(const std::string& more) {
  try {
    read_study(scenarios::parse_toml("scenario = \"redsea_square\"\n" + more, "study.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Study, TakesWhatMeasuresYield) {
  EXPECT_EQ(complaint("series = [\"quality\"]\n"
                      "[[table]]\nname = \"a\"\nmeasures = [\"energy_mean_wh\", \"fragments\"]\n"
                      "[[table]]\nname = \"b\"\nseries = [\"energy_mean_wh\"]\nevery = 10\n"
                      "against = \"centroid_path_m\"\n"),
            "");
}

TEST(Study, RefusesAMeasureThatNoMeasureYieldsWhereItIsNamed) {
  EXPECT_EQ(complaint("[[table]]\nname = \"a\"\nmeasures = [\"energy_mean\"]\n"),
            "study.toml:2: no measure yields a value \"energy_mean\"; did you mean "
            "\"energy_mean_wh\"?");
  EXPECT_NE(complaint("[[comparison]]\nname = \"a\"\nfactor = \"f\"\nreference = \"r\"\n"
                      "measures = [\"quality\"]\n")
                .find("study.toml:2: no measure yields a value \"quality\""),
            std::string::npos);
  EXPECT_NE(complaint("[[sensitivity]]\nname = \"a\"\nmeasures = [\"fragment\"]\n")
                .find("did you mean \"fragments\"?"),
            std::string::npos);
}

TEST(Study, NamesTheNewKeyForOneThatWasRenamed) {
  const std::string metrics = "name = \"a\"\nmetrics = [\"energy_mean_wh\"]\n";
  for (const std::string table : {"table", "comparison", "sensitivity", "attribution"}) {
    const std::string by_line = "[[" + table + "]]\n" + metrics;
    EXPECT_EQ(complaint(by_line), "study.toml:4: metrics is now measures; write that");
  }
  EXPECT_EQ(complaint("table = [{ name = \"a\", metrics = [\"fragments\"] }]\n"),
            "study.toml:2: metrics is now measures; write that");
}

TEST(Study, RefusesASeriesThatNoMeasureYields) {
  EXPECT_NE(
      complaint("series = [\"fragments\"]\n").find("no measure yields a series \"fragments\""),
      std::string::npos);
  EXPECT_NE(complaint("[[table]]\nname = \"a\"\nseries = [\"qualiti\"]\nevery = 60\n")
                .find("did you mean \"quality\"?"),
            std::string::npos);
  EXPECT_NE(complaint("[[table]]\nname = \"a\"\nseries = [\"quality\"]\nevery = 60\n"
                      "against = \"centroid_path\"\n")
                .find("did you mean \"centroid_path_m\"?"),
            std::string::npos);
}

}  // namespace
}  // namespace shoal::analysis
