// The statistics beside those of SciPy; tests/data/statistics_scipy.py wrote the numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "shoal/analysis/statistics/equivalence.hpp"
#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis::statistics {
namespace {

struct Row {
  std::string quantity, argument;
  std::vector<double> sample;
  double expected = 0.0;
};

std::vector<Row> rows() {
  std::ifstream file(SHOAL_SOURCE_DIR "/tests/data/statistics_scipy.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string sample, expected;
    Row row;
    std::getline(cells, row.quantity, ',');
    std::getline(cells, row.argument, ',');
    std::getline(cells, sample, ',');
    std::getline(cells, expected, ',');
    std::istringstream values(sample);
    for (double x = 0.0; values >> x;) row.sample.push_back(x);
    row.expected = std::stod(expected);
    rows.push_back(row);
  }
  return rows;
}

Alternative alternative(const Row& row) {
  static const std::map<std::string, Alternative> known{{"two-sided", Alternative::two_sided},
                                                        {"greater", Alternative::greater},
                                                        {"less", Alternative::less}};
  return known.at(row.argument);
}

double number(const Row& row) {
  return std::stod(row.argument);
}

/// One that both draw at random: each end is uncertain by about 4 % of a standard error with 10 000
/// resamples (intervals.hpp), by 0.6 % with these 400 000, and their difference by 0.9 %.
Interval bca(const Row& row) {
  return bca_interval_of_mean(row.sample, number(row), {.resamples = 400'000}).value();
}

struct Compared {
  std::function<double(const Row&)> ours;
  double tolerance = 1e-12;  ///< relative; of bca in standard errors
};

const std::map<std::string, Compared> compared{
    {"quantile", {[](const Row& r) { return quantile(r.sample, number(r)); }}},
    {"sd", {[](const Row& r) { return standard_deviation(r.sample); }}},
    {"t_low", {[](const Row& r) { return t_interval(r.sample, number(r)).value().low; }}},
    {"t_high", {[](const Row& r) { return t_interval(r.sample, number(r)).value().high; }}},
    {"paired_t",
     {[](const Row& r) { return paired_t_test(r.sample, alternative(r)).value().p_value; }}},
    {"equivalence",
     {[](const Row& r) { return equivalence_p_value(r.sample, number(r)).value(); }}},
    {"signed_rank",
     {[](const Row& r) { return signed_rank_test(r.sample, alternative(r)).value().p_value; }}},
    {"sign_flip",
     {[](const Row& r) { return sign_flip_test(r.sample, alternative(r)).value().p_value; }}},
    {"power", {[](const Row& r) {
       return paired_t_power(static_cast<int>(r.sample[0]), r.sample[1], 1.0, number(r));
     }}},
    {"bca_low", {[](const Row& r) { return bca(r).low; }, 0.04}},
    {"bca_high", {[](const Row& r) { return bca(r).high; }, 0.04}}};

TEST(Statistics, AgreeWithSciPy) {
  std::set<std::string> seen;
  for (const Row& row : rows()) {
    const Compared& with = compared.at(row.quantity);
    const bool random = row.quantity.starts_with("bca");
    const double unit = random ? standard_error(row.sample).value() : std::abs(row.expected);
    EXPECT_NEAR(with.ours(row), row.expected, with.tolerance * unit)
        << row.quantity << " " << row.argument << " n " << row.sample.size();
    seen.insert(row.quantity);
  }
  EXPECT_EQ(seen.size(), compared.size());
}

}  // namespace
}  // namespace shoal::analysis::statistics
