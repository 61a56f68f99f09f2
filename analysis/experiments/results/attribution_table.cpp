#include "shoal/analysis/experiments/results/attribution_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/analysis/statistics/sensitivity/shapley.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::size_t place_of(const std::string& group, const AttributionRequest& request,
                     const TrialList& list) {
  if (group.empty() && list.groups().size() > 1) {
    throw InputError(request.origin, "the study has several groups; name one with group");
  }
  return group.empty() ? 0 : places_of_groups({group}, list, request.origin).front();
}

/// A factor of the group: the label it is changed from, and the one it is changed to.
struct Change {
  std::string factor, from, to;
};

std::vector<Change> changes_of(const AttributionRequest& request, const TrialGroup& group) {
  std::vector<std::string> names;
  for (const Axis& axis : group.axes()) names.push_back(axis.name());
  for (const auto& [name, label] : request.reference.table()) {
    if (std::ranges::find(names, name) != names.end()) continue;
    throw InputError(label.origin, "reference names \"" + name +
                                       "\", which is no factor of the group" +
                                       suggestion(name, names));
  }
  std::vector<Change> changes;
  for (const Axis& axis : group.axes()) {
    if (axis.levels() != 2) {
      throw InputError(request.origin,
                       fmt::format("an attribution needs factors of two levels, and {} has {}",
                                   axis.name(), axis.levels()));
    }
    const Setting* chosen = request.reference.find(axis.name());
    const std::vector<std::string> labels{axis.level(0).label, axis.level(1).label};
    if (!chosen) {
      throw InputError(request.origin, "reference names no level of the factor " + axis.name() +
                                           "; it has " + listed(labels));
    }
    const std::string label = label_of(*chosen);
    if (std::ranges::find(labels, label) == labels.end()) {
      throw InputError(chosen->origin, "the factor " + axis.name() + " has no level \"" + label +
                                           "\"; it has " + listed(labels));
    }
    changes.push_back({axis.name(), label, label == labels[0] ? labels[1] : labels[0]});
  }
  return changes;
}

/// The cell with these labels of the group's own factors; `labels` are those of `changes`.
std::size_t cell_of(const AttributionRequest& request, const TrialGroup& group,
                    const std::vector<Change>& changes, const std::vector<std::string>& labels) {
  std::vector<std::string> wanted;
  for (const Axis& axis : group.axes()) {
    const auto found = std::ranges::find(changes, axis.name(), &Change::factor);
    if (found == changes.end()) {
      throw InputError(request.origin, "the group " + group.name() + " varies " + axis.name() +
                                           ", which the group it is compared with does not");
    }
    wanted.push_back(labels[static_cast<std::size_t>(found - changes.begin())]);
  }
  for (std::size_t cell = 0; cell < group.cells(); ++cell) {
    if (std::ranges::equal(group.labels(cell), wanted)) return cell;
  }
  throw InputError(request.origin, "the group " + group.name() + " has no cell " + listed(wanted) +
                                       "; an attribution needs every combination of levels");
}

/// One row a factor, and one for all of them, below those of the measures before.
class AttributionTable {
 public:
  AttributionTable(const AttributionRequest& request, const StudyResults& results)
      : request_(request), results_(results) {
    const TrialList& list = results.list();
    group_ = place_of(request.group, request, list);
    minus_ = request.minus.empty() ? group_ : place_of(request.minus, request, list);
    const TrialGroup& group = list.groups()[group_];
    if (group.sampled()) {
      throw InputError(request.origin,
                       "an attribution needs all combinations of levels, and the design " +
                           group.group().design.kind() + " draws its cells; leave it out");
    }
    if (list.groups()[minus_].replications() != group.replications()) {
      throw InputError(request.origin, "the groups of an attribution differ in replications");
    }
    changes_ = changes_of(request, group);
    for (std::size_t mask = 0; mask < std::size_t{1} << changes_.size(); ++mask) {
      std::vector<std::string> labels;
      for (std::size_t f = 0; f < changes_.size(); ++f) {
        labels.push_back((mask >> f & 1U) != 0 ? changes_[f].to : changes_[f].from);
      }
      cells_.push_back(cell_of(request, group, changes_, labels));
      if (!request.minus.empty()) {
        minus_cells_.push_back(cell_of(request, list.groups()[minus_], changes_, labels));
      }
    }
  }

  Table table() const {
    Table table{request_.name,
                request_.caption,
                {{.header = "measure"},
                 {.header = "factor"},
                 {.header = "from"},
                 {.header = "to"},
                 {.header = "share"},
                 {.header = "of all", .unit = "%", .name = "of_all_percent"},
                 {.header = "alone"},
                 {.header = "last"}},
                {},
                {}};
    for (const std::string& measure : request_.measures) add(measure, table);
    table.notes.push_back(
        "share: Shapley value of the change, its effect averaged over all orders in which the "
        "changes can be made; the shares add up to the effect of all. alone: as the only change; "
        "last: after all others. With 95 % intervals from the seeds (Student).");
    if (!request_.minus.empty()) {
      table.notes.push_back("All numbers are differences from the group " + request_.minus +
                            ", cell by cell and seed by seed.");
    }
    return table;
  }

 private:
  std::optional<double> answer(const Question& question, std::size_t mask, int k) const {
    const TrialList& list = results_.list();
    const auto own = results_.answer(question, list.index(group_, cells_[mask], k)).bounded();
    if (request_.minus.empty() || !own) return own;
    const auto other =
        results_.answer(question, list.index(minus_, minus_cells_[mask], k)).bounded();
    return other ? std::optional(*own - *other) : std::nullopt;
  }

  ShapleyAttribution attribution(const std::string& measure) const {
    const Question question{measure, "", "", 0.0};
    std::vector<std::optional<double>> answers;
    for (int k = 0; k < results_.list().groups()[group_].replications(); ++k) {
      for (std::size_t mask = 0; mask < cells_.size(); ++mask) {
        answers.push_back(answer(question, mask, k));
      }
    }
    return shapley_attribution(answers, static_cast<int>(changes_.size()), confidence);
  }

  void add(const std::string& measure, Table& table) const {
    const Quantity& quantity = known_value(measure, request_.origin);
    const std::string unit = quantity.unit.empty() ? "" : " (" + quantity.unit + ")";
    const ShapleyAttribution result = attribution(measure);
    std::string note = fmt::format("{}: {} seeds", measure, result.seeds);
    if (result.left_out > 0) {
      note += fmt::format(", {} left out, of which some answer is missing", result.left_out);
    }
    if (!result.undefined.empty()) {
      table.notes.push_back(note + "; no shares: " + result.undefined + ".");
      return;
    }
    // All in the decimals of the whole, so that they can be seen to add up.
    const IndexEstimate& whole = result.together;
    const Digits digits = whole.interval
                              ? decimals_for(0.5 * (whole.interval->high - whole.interval->low))
                              : Digits::significant(6);
    const auto cell = [&](const IndexEstimate& estimate) -> Cell {
      Estimate shown{.value = estimate.value, .digits = digits};
      if (estimate.interval) {
        shown.uncertainty = Between{estimate.interval->low, estimate.interval->high};
      }
      return shown;
    };
    const auto percent = [&](double share) -> Cell {
      if (!whole.distinguishable()) return Missing{};
      return Estimate{.value = 100.0 * share / whole.value, .digits = Digits::decimals(0)};
    };
    for (std::size_t f = 0; f < changes_.size(); ++f) {
      const ShapleyFactor& factor = result.factors[f];
      table.rows.push_back({heading_of(quantity) + unit, changes_[f].factor, changes_[f].from,
                            changes_[f].to, cell(factor.share), percent(factor.share.value),
                            cell(factor.alone), cell(factor.last)});
    }
    table.rows.push_back({heading_of(quantity) + unit, std::string("all"), Missing{}, Missing{},
                          cell(whole), percent(whole.value), Missing{}, Missing{}});
    table.notes.push_back(fmt::format(
        "{}; {:.4g} at the reference, {:.4g} with all changed{}.", note, result.before.value,
        result.after.value,
        whole.distinguishable() ? "" : ", which the seeds do not tell apart: no percentages"));
  }

  const AttributionRequest& request_;
  const StudyResults& results_;
  std::size_t group_ = 0, minus_ = 0;
  std::vector<Change> changes_;
  std::vector<std::size_t> cells_, minus_cells_;  // by which factors are changed, a bit each
};

}  // namespace

Table attribution_table(const AttributionRequest& request, const StudyResults& results) {
  return AttributionTable(request, results).table();
}

}  // namespace shoal::analysis
