#include "shoal/analysis/study/claim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/study/confidence.hpp"
#include "shoal/analysis/study/slices.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::vector<std::size_t> groups_of(const Claim& claim, const StudyPlan& plan) {
  if (claim.groups.empty() && plan.groups().size() > 1) {
    throw InputError(claim.origin, "the study has several groups; say which the claim is about");
  }
  return places_of_groups(claim.groups, plan, claim.origin);
}

void require_columns(const CellSelection& selection, const PlannedGroup& group,
                     const Origin& origin) {
  for (const auto& [name, labels] : selection.wanted()) {
    if (std::ranges::find(group.columns(), name) != group.columns().end()) continue;
    const std::string owner = group.name().empty() ? "the study" : "the group " + group.name();
    throw InputError(origin,
                     owner + " has no factor \"" + name + '"' + suggestion(name, group.columns()));
  }
}

/// The cells that `where` leaves, parted by the factors that the claim does not compare.
std::vector<ClaimScope> scopes(const Claim& claim, const Question& question,
                               const StudyResults& results, const ClaimTest& test) {
  const CellSelection where(claim.where);
  const std::vector<std::string> compared = test.compared();
  std::vector<ClaimScope> scopes;
  const std::vector<std::size_t> groups = groups_of(claim, results.plan());
  for (const std::size_t g : groups) {
    const PlannedGroup& group = results.plan().groups()[g];
    require_columns(where, group, claim.origin);
    std::map<std::string, std::size_t> known;  // title of the fixed factors -> scope
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      if (!where.holds(group.columns(), group.labels(cell))) continue;
      std::string title = groups.size() > 1 ? group.name() : "";
      for (std::size_t i = 0; i < group.columns().size(); ++i) {
        const std::string& column = group.columns()[i];
        if (std::ranges::find(compared, column) != compared.end() || where.names_one(column))
          continue;
        title += (title.empty() ? "" : ", ") + group.labels(cell)[i];
      }
      const auto [place, fresh] = known.emplace(title, scopes.size());
      if (fresh) scopes.push_back({results, question, g, {}, title});
      scopes[place->second].cells.push_back(cell);
    }
  }
  if (scopes.empty()) throw InputError(claim.origin, "no cell of the study is as `where` says");
  return scopes;
}

/// Whether each number is as claimed: it takes one to contradict, and all to reproduce.
ContrastResult judged_each(const Contrast& contrast) {
  const auto [least, greatest] = std::ranges::minmax(contrast.numbers);
  const bool outside =
      (contrast.low && least < *contrast.low) || (contrast.high && greatest > *contrast.high);
  return {.title = contrast.title,
          .n = static_cast<int>(contrast.numbers.size()),
          .mean = statistics::mean(contrast.numbers),
          .low = least,
          .high = greatest,
          .of_each = true,
          .verdict = outside                 ? Verdict::contradicted
                     : contrast.missing == 0 ? Verdict::reproduced
                                             : Verdict::undecided};
}

ContrastResult judged(const Contrast& contrast, double corrected_level) {
  if (contrast.of_each && !contrast.numbers.empty()) return judged_each(contrast);
  ContrastResult result{.title = contrast.title, .n = static_cast<int>(contrast.numbers.size())};
  if (contrast.numbers.empty()) return result;
  result.mean = statistics::mean(contrast.numbers);
  const auto interval = statistics::t_interval(contrast.numbers, confidence);
  const auto wide = statistics::t_interval(contrast.numbers, corrected_level);
  if (!interval || !wide) return result;
  result.low = interval->low;
  result.high = interval->high;
  const bool inside = (!contrast.low || interval->low > *contrast.low) &&
                      (!contrast.high || interval->high < *contrast.high);
  const bool outside =
      (contrast.low && wide->high < *contrast.low) || (contrast.high && wide->low > *contrast.high);
  if (inside) result.verdict = Verdict::reproduced;
  if (outside) result.verdict = Verdict::contradicted;
  return result;
}

/// Replications that would tell the mean of a contrast from the nearer end of what is claimed.
std::optional<int> needed(const Contrast& contrast) {
  if (contrast.of_each || contrast.numbers.size() < 2) return std::nullopt;
  const double mean = statistics::mean(contrast.numbers);
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& end : {contrast.low, contrast.high}) {
    if (end) distance = std::min(distance, std::abs(mean - *end));
  }
  const double sd = statistics::standard_deviation(contrast.numbers);
  if (!statistics::standard_error(contrast.numbers) || distance == 0.0) return std::nullopt;
  return statistics::replications_for(distance, sd, 1.0 - confidence, wanted_power);
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::contradicted:
      return "contradicted";
    case Verdict::undecided:
      return "undecided";
  }
  return "?";
}

std::size_t ClaimScope::cell(const CellSelection& selection) const {
  const PlannedGroup& planned = results.plan().groups()[group];
  require_columns(selection, planned, selection.origin());
  std::optional<std::size_t> found;
  for (const std::size_t candidate : cells) {
    if (!selection.holds(planned.columns(), planned.labels(candidate))) continue;
    if (found) {
      throw InputError(selection.origin(), "several cells have " + selection.text() +
                                               "; name more factors, here or in where");
    }
    found = candidate;
  }
  if (!found) {
    throw InputError(selection.origin(),
                     "no cell has " + selection.text() + (title.empty() ? "" : " with " + title));
  }
  return *found;
}

std::vector<std::optional<double>> ClaimScope::answers(std::size_t cell) const {
  std::vector<std::optional<double>> answers;
  for (int k = 0; k < results.plan().groups()[group].replications(); ++k) {
    answers.push_back(results.answer(question, results.plan().index(group, cell, k)).bounded());
  }
  return answers;
}

ClaimResult test_claim(const Claim& claim, const StudyResults& results) {
  const Question question{claim.metric, claim.series, "", claim.at_s};
  const auto test = claim.test.make();
  std::vector<Contrast> contrasts;
  for (const ClaimScope& scope : scopes(claim, question, results, *test)) {
    for (Contrast& contrast : test->contrasts(scope)) {
      if (!scope.title.empty()) {
        contrast.title = scope.title + (contrast.title.empty() ? "" : ": " + contrast.title);
      }
      contrasts.push_back(std::move(contrast));
    }
  }
  const double corrected = 1.0 - (1.0 - confidence) / static_cast<double>(contrasts.size());
  ClaimResult result;
  int most = 0;
  bool all = true, known = true;
  for (const Contrast& contrast : contrasts) {
    result.contrasts.push_back(judged(contrast, corrected));
    const Verdict verdict = result.contrasts.back().verdict;
    if (verdict == Verdict::contradicted) result.verdict = Verdict::contradicted;
    all &= verdict == Verdict::reproduced;
    if (verdict == Verdict::reproduced) continue;
    const std::optional<int> n = needed(contrast);
    known &= n.has_value();
    most = std::max(most, n.value_or(0));
  }
  if (all) result.verdict = Verdict::reproduced;
  if (result.verdict == Verdict::undecided && known) result.replications_needed = most;
  return result;
}

}  // namespace shoal::analysis
