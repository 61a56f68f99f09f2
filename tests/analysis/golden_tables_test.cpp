// Every form of some tables, as files in tests/analysis/golden_tables. After a change that is
// meant,
//
//     SHOAL_RENEW_TABLES=1 build/ci/bin/analysis_test --gtest_filter='*GoldenTables*'
//
// writes them anew; look at what git says has changed. latex_test.py compiles those in LaTeX.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "shoal/analysis/tables/table_format.hpp"

namespace shoal::analysis {
namespace {

Cell count(int number) {
  return Estimate{.value = static_cast<double>(number), .digits = Digits::decimals(0)};
}

Estimate estimate(double value, Uncertainty uncertainty, int decimals) {
  return {.value = value, .uncertainty = uncertainty, .digits = Digits::decimals(decimals)};
}

Estimate of(int n, Estimate estimate, int failed = 0) {
  estimate.n = n;
  estimate.failed = failed;
  return estimate;
}

Estimate best(Estimate estimate) {
  estimate.best = true;
  return estimate;
}

Table plain() {
  return {.name = "plain",
          .caption = "Texts, counts and numbers",
          .columns = {{"solver"}, {"problems"}, {"solved", "%"}, {"median", "us"}, {"remark"}},
          .rows = {{"newton", count(2980), estimate(100.0, {}, 2), Estimate{0.732}, "ours"},
                   {"nlopt.slsqp", count(298), estimate(99.866, {}, 2), Estimate{134.0}, Missing{}},
                   {"ceres", count(0), Missing{}, Missing{}, "not built"}}};
}

/// Means with intervals of two kinds, under headers that span them.
Table spanning() {
  const auto bounds = [](double mean, double low, double high) {
    return of(5, estimate(mean, Between{low, high}, 1));
  };
  const auto energy = [](double mean, double by) {
    return of(5, estimate(mean, PlusMinus{by}, decimals_for(by).number));
  };
  return {
      .name = "ping_period",
      .caption = "Energy and quality of a construction against the ping period",
      .columns = {{"behaviour"},
                  {"5", "", "energy (Wh) at ping period", "s"},
                  {"30", "", "energy (Wh) at ping period", "s"},
                  {"120", "", "energy (Wh) at ping period", "s"},
                  {"5", "", "quality", "m"},
                  {"30", "", "quality", "m"}},
      .rows = {{"attraction_repulsion", energy(77.54, 5.61), best(energy(67.4, 4.7)),
                energy(112.3, 14.2), bounds(50.2, 8.4, 92.1), bounds(60.4, 51.3, 69.9)},
               {"pairwise_referencing", best(energy(9.42, 0.31)), energy(33.82, 0.12),
                best(energy(51.0, 2.4)), best(bounds(7.3, 6.9, 7.8)), bounds(17.3, 15.2, 104.5)},
               {"rigid_registration", energy(36.2, 1.1), energy(34.42, 0.96), energy(130.9, 20.5),
                bounds(21.3, 19.0, 23.6), best(bounds(9.46, 8.95, 10.08))}},
      .notes = {"Energy: mean ± half the width of Student's 95 % confidence interval.",
                "Quality: median [quartiles]."}};
}

Table failures() {
  const auto mean = [](double value, double sd) { return estimate(value, Deviation{sd}, 1); };
  return {.name = "node_loss",
          .caption = "Trials that failed",
          .columns = {{"behaviour"},
                      {.header = "energy", .unit = "Wh", .name = "energy_mean_wh"},
                      {.header = "quality", .unit = "m", .name = "quality_m"}},
          .rows = {{"rigid", best(of(5, mean(36.2, 1.1))), of(5, mean(21.3, 10.2))},
                   {"pairwise", of(4, mean(37.9, 0.8), 1), best(of(5, mean(7.3, 0.4)))},
                   {"assignment", best(of(3, mean(36.2, 12.4))), of(4, mean(9.5, 0.6), 1)},
                   {"attraction", Missing{.failed = 5}, Missing{}},
                   {"alone", of(1, estimate(40.0, {}, 1)), of(1, estimate(8.0, {}, 1))}},
          .notes = {"Mean (standard deviation)."}};
}

Table negative() {
  const auto change = [](double value, double low, double high) {
    return estimate(value, Between{low, high}, 2);
  };
  return {.name = "negative",
          .caption = "Signs on either side",
          .columns = {{"what"}, {"change", "m/Wh"}, {"turn", "deg"}, {"count"}},
          .rows = {{"less", change(-3.42, -12.5, -0.004), estimate(-43.8, PlusMinus{10.25}, 1),
                    best(estimate(-13.0, {}, 0))},
                   {"more", best(change(12.07, 3.1, 104.9)),
                    best(estimate(147.3, PlusMinus{4.5}, 1)), count(7)},
                   {"neither", change(0.01, -0.3, 0.2), estimate(0.0, PlusMinus{0.2}, 1),
                    count(120345)}}};
}

Table magnitudes() {
  const auto row = [](std::string name, double value, double by) -> std::vector<Cell> {
    return {std::move(name),
            Estimate{.value = value, .uncertainty = PlusMinus{by}, .digits = decimals_for(by)},
            Estimate{.value = value}};
  };
  Table table{
      .name = "magnitudes",
      .caption = "Very large and very small numbers",
      .columns = {{"what"}, {"two digits of the uncertainty"}, {"three digits"}},
      .rows = {row("large", 6.02214e23, 1.2e20), row("kilo", 12338.0, 243.0), row("one", 1.5, 0.25),
               row("small", -1.2e-9, 3.4e-11), row("drowned", 1e-10, 3e-9)}};
  std::get<Estimate>(table.rows[3][1]).best = true;
  return table;
}

Table special() {
  return {.name = "special:characters-1.0",
          .caption = R"(50% of all & more_than $5, #1 {braces} a\b ~c ^d "quoted" --set <x>|y`z)",
          .columns = {{"na|me_of *it*", "m^2"}, {"share", "%"}, {"a_b, \"c\"", "x_y"}},
          .rows = {{R"(C:\new_{50%} & $x^2$ ~#1)", estimate(1.0, {}, 1), estimate(1.0, {}, 0)},
                   {"Čapljina, Šibenik ± ü", estimate(2.0, {}, 1), estimate(2.0, {}, 0)},
                   {"[1] in brackets", estimate(4.0, {}, 1), estimate(4.0, {}, 0)},
                   {"*starred*", estimate(5.0, {}, 1), estimate(5.0, {}, 0)},
                   {"--set a=\"b\", <c>", estimate(3.0, {}, 1), Missing{}},
                   {"two\nlines_ | `code` *bold*", Missing{}, Missing{}}},
          .notes = {"All of 100% & more_of_it | *as it stands*."}};
}

/// Wider than a page: envelopes against time under each of five ping periods.
Table wide() {
  Table table{.name = "wide",
              .caption = "More than a page is wide: it is scaled down",
              .columns = {{"time", "s"}}};
  for (const char* period : {"5", "15", "30", "60", "120"}) {
    table.columns.push_back({period, "s", "energy (Wh) at ping period", "s"});
  }
  for (const double time : {300.0, 600.0, 900.0}) {
    table.rows.push_back({estimate(time, {}, 0)});
    for (int k = 0; k < 5; ++k) {
      const double mean = 1000.0 + time + k;
      table.rows.back().push_back(of(5, estimate(mean, Between{mean - 20.4, mean + 31.7}, 2)));
    }
  }
  table.notes = {"Mean [least, greatest]."};
  return table;
}

/// Sentences, beside numbers: broken into lines, and into pages.
Table sentences() {
  Table table{.name = "sentences",
              .caption = "What is said, and what was found",
              .columns = {{"no."}, {"statement"}, {"ratio", ""}, {"what was found"}}};
  const std::string says = "Rigid registration spends more than pairwise referencing";
  const std::string found =
      "behaviour = rigid_registration - behaviour = pairwise_referencing: difference [2.4, 2.6] "
      "Wh, claimed above 2 % of the other's: as claimed; [in brackets] corrected over 222 verdicts";
  for (int k = 1; k <= 4; ++k) {
    table.rows.push_back(
        {std::to_string(k), says, of(5, estimate(1.02 * k, PlusMinus{0.31}, 2)), found});
  }
  table.rows.push_back({"5", "[short]", Missing{}, ""});
  table.notes = {"Mean +- half the width of the 95 % interval."};
  return table;
}

Table empty() {
  return {.name = "empty",
          .caption = "Nothing yet",
          .columns = {{"behaviour"}, {"5", "s", "energy", "Wh"}, {"30", "s", "energy", "Wh"}}};
}

struct Case {
  const char* name;
  Table (*make)();
};

constexpr Case cases[] = {
    {"plain", plain},       {"spanning", spanning},     {"failures", failures},
    {"negative", negative}, {"magnitudes", magnitudes}, {"special", special},
    {"wide", wide},         {"sentences", sentences},   {"empty", empty}};

class GoldenTables : public testing::TestWithParam<Case> {};

TEST_P(GoldenTables, ArePrintedAsBefore) {
  const std::pair<const char*, std::string> forms[] = {
      {"txt", "text"}, {"csv", "csv"}, {"md", "markdown"}, {"tex", "latex"}, {"html", "html"}};
  const bool renew = std::getenv("SHOAL_RENEW_TABLES") != nullptr;
  for (const auto& [ending, format] : forms) {
    const std::string path = std::string(SHOAL_SOURCE_DIR "/tests/analysis/golden_tables/") +
                             GetParam().name + "." + ending;
    const std::string printed = table_format(format)->print(GetParam().make());
    if (renew) std::ofstream(path, std::ios::binary) << printed;
    std::ostringstream golden;
    golden << std::ifstream(path, std::ios::binary).rdbuf();
    EXPECT_EQ(printed, golden.str()) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(All, GoldenTables, testing::ValuesIn(cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace shoal::analysis
