#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/analysis/benchmarking/solver_comparison.hpp"

namespace shoal::analysis {
namespace {

using Point = solvers::Trace::Point;

/// The costs between which all solvers descend, problem by problem.
struct Descents {
  std::vector<double> first, lowest;

  explicit Descents(const ContenderFamily& family)
      : first(family.contenders.front().answers.size(), -std::numeric_limits<double>::infinity()),
        lowest(first.size(), std::numeric_limits<double>::infinity()) {
    for (const Contender& contender : family.contenders) {
      for (std::size_t k = 0; k < first.size(); ++k) {
        const std::vector<Point>& progress = contender.answers[k].progress;
        if (progress.empty()) continue;
        first[k] = std::max(first[k], progress.front().cost);
        lowest[k] = std::min(lowest[k], progress.back().cost);
      }
    }
  }

  double left(std::size_t k, double cost) const {
    const double whole = first[k] - lowest[k];
    return whole > 0.0 ? (cost - lowest[k]) / whole : 0.0;
  }
};

/// From the least effort at which anything is known to the greatest that changes anything, four
/// steps an octave; of whole numbers each once.
std::vector<double> efforts(const ContenderFamily& family, auto effort, bool whole) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  for (const Contender& contender : family.contenders) {
    for (const SolverAnswer& answer : contender.answers) {
      if (answer.progress.empty()) continue;
      least = std::min(least, effort(answer.progress.front()));
      greatest = std::max(greatest, effort(answer.progress.back()));
    }
  }
  std::vector<double> steps;
  for (int k = 0; least <= greatest; ++k) {
    const double exact = least * std::exp2(0.25 * k);
    const double step = whole ? std::ceil(exact) : exact;
    if (steps.empty() || step > steps.back()) steps.push_back(step);
    if (step >= greatest) break;
  }
  return steps;
}

/// Closed forms and enumerations: they solve, and there is nothing on the way.
bool is_at_once(const Contender& contender) {
  return std::ranges::any_of(contender.answers, [](const SolverAnswer& answer) {
    return answer.solved() && answer.progress.empty();
  });
}

double quartile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = place - std::floor(place);
  return (1.0 - part) * sorted[below] + part * sorted[above];
}

void add_curves(const ContenderFamily& family, const char* measure, bool whole, auto effort,
                Table& table) {
  const Descents descents(family);
  const std::vector<double> steps = efforts(family, effort, whole);
  for (const Contender& contender : family.contenders) {
    if (is_at_once(contender)) continue;
    for (const double step : steps) {
      std::vector<double> left;
      for (std::size_t k = 0; k < contender.answers.size(); ++k) {
        const std::vector<Point>& progress = contender.answers[k].progress;
        const auto next = std::ranges::find_if(
            progress, [&](const Point& point) { return effort(point) > step; });
        left.push_back(next == progress.begin() ? 1.0 : descents.left(k, std::prev(next)->cost));
      }
      std::ranges::sort(left);
      std::vector<Cell> row{family.name, measure, contender.name,
                            Estimate{.value = step, .digits = Digits::significant(4)}};
      for (const double share : {0.5, 0.25, 0.75}) {
        row.emplace_back(
            Estimate{.value = quartile(left, share), .digits = Digits::significant(6)});
      }
      table.rows.push_back(std::move(row));
    }
  }
}

}  // namespace

Table progress_curves(const SolverComparison& comparison) {
  Table table;
  for (const char* header :
       {"family", "measure", "solver", "effort", "left", "left_low", "left_high"}) {
    table.columns.push_back({.header = header});
  }
  for (const ContenderFamily* family : comparison.families()) {
    add_curves(
        *family, "seconds", false, [](const Point& point) { return point.seconds; }, table);
    add_curves(
        *family, "evaluations", true,
        [](const Point& point) { return static_cast<double>(point.evaluations); }, table);
  }
  return table;
}

}  // namespace shoal::analysis
