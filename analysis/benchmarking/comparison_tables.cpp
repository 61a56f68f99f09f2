#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "shoal/analysis/benchmarking/solver_comparison.hpp"

namespace shoal::analysis {
namespace {

std::size_t problems(const ContenderFamily& family) {
  return family.contenders.front().answers.size();
}

/// Per problem, the least of a quantity among the answers that solve it; infinite if none does.
template <class Quantity>
std::vector<double> least(const ContenderFamily& family, Quantity quantity) {
  std::vector<double> values(problems(family), std::numeric_limits<double>::infinity());
  for (const Contender& contender : family.contenders) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const SolverAnswer& answer = contender.answers[k];
      if (answer.solved()) values[k] = std::min(values[k], static_cast<double>(quantity(answer)));
    }
  }
  return values;
}

Cell number(double value, Digits digits) {
  return Estimate{.value = value, .digits = digits};
}

Cell count(std::size_t value) {
  return number(static_cast<double>(value), Digits::decimals(0));
}

Cell quantile(std::vector<double> values, double share) {
  if (values.empty()) return Missing{};
  const double place = std::round(share * static_cast<double>(values.size() - 1));
  const auto wanted = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(values, wanted);
  return number(*wanted, Digits::significant(3));
}

Cell percent(std::size_t part, std::size_t whole) {
  return number(100.0 * static_cast<double>(part) / static_cast<double>(whole),
                Digits::decimals(2));
}

/// What became of one contender's problems.
struct Tally {
  std::size_t solved = 0, same = 0, other = 0;
  double worst_gap = 0.0;
  std::vector<double> evaluations, microseconds;
  std::map<std::string, std::size_t> failures;

  Cell failed() const {
    std::string text;
    for (const auto& [status, count] : failures) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status);
    }
    if (text.empty()) return Missing{};
    return text;
  }
};

Tally tally_of(const Contender& contender, const Contender& reference,
               const std::vector<double>& lowest, double same_within_m) {
  Tally tally;
  for (std::size_t k = 0; k < contender.answers.size(); ++k) {
    const SolverAnswer& answer = contender.answers[k];
    if (!answer.solved()) {
      ++tally.failures[answer.refusal.empty() ? std::string(name_of(answer.status))
                                              : "refused: " + answer.refusal];
      continue;
    }
    ++tally.solved;
    tally.evaluations.push_back(answer.evaluations);
    tally.microseconds.push_back(1e6 * answer.seconds);
    tally.worst_gap = std::max(tally.worst_gap, answer.cost - lowest[k]);
    const SolverAnswer& known = reference.answers[k];
    if (!known.solved()) continue;
    const bool near = (answer.place - known.place).norm() <= same_within_m;
    ++(near ? tally.same : tally.other);
  }
  return tally;
}

template <class Effort>
void add_profile(const ContenderFamily& family, const char* measure, Effort effort, Table& table) {
  constexpr int octaves = 14, steps_per_octave = 4;
  const std::vector<double> best = least(family, effort);
  for (const Contender& contender : family.contenders) {
    for (int step = 0; step <= octaves * steps_per_octave; ++step) {
      const double factor = std::exp2(static_cast<double>(step) / steps_per_octave);
      double within = 0.0;
      for (std::size_t k = 0; k < best.size(); ++k) {
        const SolverAnswer& answer = contender.answers[k];
        within += answer.solved() && effort(answer) <= factor * best[k] ? 1.0 : 0.0;
      }
      table.rows.push_back(
          {family.name, measure, contender.name, number(factor, Digits::significant(4)),
           number(within / static_cast<double>(best.size()), Digits::decimals(5))});
    }
  }
}

}  // namespace

Table comparison_table(const SolverComparison& comparison, double same_within_m) {
  Table table;
  for (const char* header :
       {"family", "solver", "problems", "solved %", "same minimum %", "other minimum %",
        "evaluations", "median us", "p95 us", "worst gap", "not solved"}) {
    table.columns.push_back({.header = header});
  }
  for (const ContenderFamily* family : comparison.families()) {
    const std::vector<double> lowest =
        least(*family, [](const SolverAnswer& answer) { return answer.cost; });
    const std::size_t posed = problems(*family);
    for (const Contender& contender : family->contenders) {
      const Tally tally =
          tally_of(contender, family->contenders[family->reference], lowest, same_within_m);
      Cell gap;
      if (tally.solved > 0) gap = number(tally.worst_gap, Digits::significant(2));
      table.rows.push_back({family->name, contender.name, count(posed),
                            percent(tally.solved, posed), percent(tally.same, posed),
                            percent(tally.other, posed), quantile(tally.evaluations, 0.5),
                            quantile(tally.microseconds, 0.5), quantile(tally.microseconds, 0.95),
                            gap, tally.failed()});
    }
  }
  return table;
}

Table performance_profiles(const SolverComparison& comparison) {
  Table table;
  for (const char* header : {"family", "measure", "solver", "factor", "share"}) {
    table.columns.push_back({.header = header});
  }
  for (const ContenderFamily* family : comparison.families()) {
    add_profile(
        *family, "seconds", [](const SolverAnswer& answer) { return answer.seconds; }, table);
    const auto evaluations = [](const SolverAnswer& answer) { return answer.evaluations; };
    if (std::ranges::any_of(least(*family, evaluations), [](double n) { return n > 0.0; })) {
      add_profile(*family, "evaluations", evaluations, table);
    }
  }
  return table;
}

}  // namespace shoal::analysis
