// Answers questions about samples, a line each, for tests/analysis/statistics_test.py:
//
//     QUANTITY <tab> ARGUMENT <tab> SAMPLE [<tab> SAMPLE ...]
//
// A sample's values are separated by blanks; of event times, a negative one is the end of a watch.
// The answer is numbers separated by blanks, or `none`.

#include <fmt/format.h>

#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "shoal/analysis/statistics/effect_size.hpp"
#include "shoal/analysis/statistics/equivalence.hpp"
#include "shoal/analysis/statistics/holm.hpp"
#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/statistics/shape.hpp"
#include "shoal/analysis/statistics/summary.hpp"
#include "shoal/analysis/statistics/survival.hpp"

namespace {

namespace statistics = shoal::analysis::statistics;

struct Asked {
  std::string argument;
  std::vector<std::vector<double>> samples;

  const std::vector<double>& sample() const { return samples.at(0); }
  double number() const { return std::stod(argument); }
  statistics::Alternative alternative() const {
    using enum statistics::Alternative;
    static const std::map<std::string, statistics::Alternative> known{
        {"two-sided", two_sided}, {"greater", greater}, {"less", less}};
    return known.at(argument);
  }
  std::vector<std::vector<statistics::EventTime>> event_times() const {
    std::vector<std::vector<statistics::EventTime>> all;
    for (const std::vector<double>& sample : samples) {
      auto& times = all.emplace_back();
      for (const double x : sample) times.push_back({std::abs(x), x > 0.0});
    }
    return all;
  }
};

using Numbers = std::optional<std::vector<double>>;

Numbers some(std::initializer_list<double> numbers) {
  return std::vector<double>(numbers);
}

Numbers of(const std::optional<double>& number) {
  return number ? some({*number}) : std::nullopt;
}
Numbers of(const std::optional<statistics::Interval>& interval) {
  return interval ? some({interval->low, interval->high}) : std::nullopt;
}
Numbers of(const std::optional<statistics::TestResult>& result) {
  return result ? some({result->statistic, result->p_value}) : std::nullopt;
}

Numbers kaplan_meier(const Asked& asked) {
  std::vector<double> numbers;
  for (const statistics::SurvivalStep& step : statistics::kaplan_meier(asked.event_times().at(0))) {
    numbers.insert(numbers.end(), {step.time, step.surviving, step.variance});
  }
  return numbers;
}

Numbers restricted_mean(const Asked& asked) {
  const auto result = statistics::restricted_mean(asked.event_times().at(0), asked.number());
  return result ? some({result->mean, result->variance}) : std::nullopt;
}

Numbers log_rank(const Asked& asked) {
  const auto result = statistics::log_rank(asked.event_times());
  return result ? some({result->chi_squared, double(result->degrees), result->p_value})
                : std::nullopt;
}

Numbers two_groups(const Asked& asked) {
  const auto result = statistics::two_groups(asked.sample());
  return result
             ? some({double(result->low_n), result->low_mean, result->high_mean, result->explained})
             : std::nullopt;
}

const std::map<std::string, std::function<Numbers(const Asked&)>> known{
    {"quantile", [](const Asked& a) { return of(statistics::quantile(a.sample(), a.number())); }},
    {"sd", [](const Asked& a) { return of(statistics::standard_deviation(a.sample())); }},
    {"t_interval",
     [](const Asked& a) { return of(statistics::t_interval(a.sample(), a.number())); }},
    {"bca_interval",
     [](const Asked& a) {
       return of(statistics::bca_interval_of_mean(a.sample(), a.number(), {.resamples = 10'000}));
     }},
    {"paired_t",
     [](const Asked& a) { return of(statistics::paired_t_test(a.sample(), a.alternative())); }},
    {"signed_rank",
     [](const Asked& a) { return of(statistics::signed_rank_test(a.sample(), a.alternative())); }},
    {"sign_flip",
     [](const Asked& a) { return of(statistics::sign_flip_test(a.sample(), a.alternative())); }},
    {"hedges_g_z", [](const Asked& a) { return of(statistics::hedges_g_z(a.sample())); }},
    {"rank_biserial",
     [](const Asked& a) { return of(statistics::rank_biserial_correlation(a.sample())); }},
    {"equivalence",
     [](const Asked& a) { return of(statistics::equivalence_p_value(a.sample(), a.number())); }},
    {"holm", [](const Asked& a) { return Numbers(statistics::holm(a.sample())); }},
    {"power",  // n, effect
     [](const Asked& a) {
       return of(statistics::paired_t_power(static_cast<int>(a.sample()[0]), a.sample()[1], 1.0,
                                            a.number()));
     }},
    {"kaplan_meier", kaplan_meier},
    {"restricted_mean", restricted_mean},
    {"log_rank", log_rank},
    {"dip", [](const Asked& a) { return of(statistics::dip(a.sample())); }},
    {"dip_p_value", [](const Asked& a) { return of(statistics::dip_p_value(a.sample())); }},
    {"skewness", [](const Asked& a) { return of(statistics::skewness(a.sample())); }},
    {"skewness_p_value",
     [](const Asked& a) { return of(statistics::skewness_p_value(a.sample())); }},
    {"two_groups", two_groups}};

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream fields(line);
    std::string quantity, text;
    Asked asked;
    std::getline(fields, quantity, '\t');
    std::getline(fields, asked.argument, '\t');
    while (std::getline(fields, text, '\t')) {
      std::istringstream values(text);
      auto& sample = asked.samples.emplace_back();
      for (double x = 0.0; values >> x;) sample.push_back(x);
    }
    const Numbers numbers = known.at(quantity)(asked);
    std::string answer;
    for (const double x : numbers.value_or(std::vector<double>{})) {
      answer += fmt::format("{}{}", answer.empty() ? "" : " ", x);
    }
    std::cout << (numbers ? answer : "none") << '\n';
  }
}
