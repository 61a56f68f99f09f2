#include "shoal/analysis/experiments/claims/tests/margin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shoal/analysis/statistics/sample.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {

Margin given_margin(const Margin& margin, const std::string& name, const Origin& origin) {
  if ((margin.absolute > 0.0) != (margin.percent > 0.0)) return margin;
  const std::string options = name + " or " + name + "_percent";
  throw InputError(origin, margin.absolute > 0.0 ? "the test takes " + options + ", not both"
                                                 : "the test needs " + options + ", above 0");
}

double Margin::beside(double other) const {
  return absolute + percent / 100.0 * std::abs(other);
}

std::string Margin::text(const std::vector<double>& values, const std::string& unit,
                         const std::string& others) const {
  if (percent == 0.0) return number_text(absolute, unit);
  const std::string text = fmt::format("{:g} % of {}", percent, others);
  if (values.empty()) return text;
  return text + " (" + number_text(beside(statistics::mean(values)), unit) + ")";
}

Contrast directed_difference(const ClaimScope& scope, CellPlace ours, CellPlace theirs, double sign,
                             const Margin& margin) {
  const SharedNumbers numbers = scope.numbers({ours, theirs});
  const std::vector<double> shown = differences(numbers.of[0], numbers.of[1]);
  std::vector<double> beyond;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    beyond.push_back(sign * shown[k] - margin.beside(numbers.of[1][k]));
  }
  Contrast contrast = counted(numbers, scope.asked.unit());
  contrast.quantity = "difference";
  contrast.claimed =
      (sign > 0.0 ? "above " : "below -") + margin.text(numbers.of[1], contrast.unit);
  judge(contrast, shown, {std::move(beyond)}, scope.asked.average);
  set_against(contrast, sign);
  return contrast;
}

void set_against(Contrast& contrast, double sign) {
  contrast.against = Against::too_small;
  if (!contrast.estimate) return;
  const double low = contrast.interval ? contrast.interval->low : *contrast.estimate;
  const double high = contrast.interval ? contrast.interval->high : *contrast.estimate;
  if (sign > 0.0 ? high < 0.0 : low > 0.0) contrast.against = Against::opposite;
}

Contrast counted(const SharedNumbers& numbers, const std::string& unit) {
  return {.unit = unit,
          .n = static_cast<int>(numbers.count()),
          .trials = numbers.trials,
          .never_reached = numbers.never_reached};
}

std::vector<double> differences(const std::vector<double>& ours,
                                const std::vector<double>& theirs) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < ours.size(); ++k) differences.push_back(ours[k] - theirs[k]);
  return differences;
}

std::string number_text(double number, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", number, unit.empty() ? "" : " ", unit);
}

void require_levels(const ClaimScope& scope, const std::string& factor, std::size_t count) {
  for (const CellPlace place : scope.cells) {
    const TrialGroup& group = scope.results.list().groups()[place.group];
    if (std::ranges::find(group.columns(), factor) != group.columns().end()) continue;
    throw InputError(scope.asked.origin, "the group " + group.name() + " has no factor \"" +
                                             factor + '"' + suggestion(factor, group.columns()));
  }
  if (scope.cells.size() >= count) return;
  throw InputError(scope.asked.origin,
                   fmt::format("the test needs {} levels of {}", count, factor));
}

void require_mean(const TestedStatement& asked, const std::string& test) {
  if (asked.average == Average::mean) return;
  throw InputError(asked.origin, "the test " + test + " is not on an average; leave statistic out");
}

}  // namespace shoal::analysis
