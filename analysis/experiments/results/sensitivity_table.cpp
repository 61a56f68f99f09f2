#include "shoal/analysis/experiments/results/sensitivity_table.hpp"

#include <algorithm>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/analysis/statistics/sensitivity/morris_effects.hpp"
#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"

namespace shoal::analysis {
namespace {

std::size_t analysed_group(const SensitivityRequest& request, const TrialList& list) {
  if (request.group.empty() && list.groups().size() > 1) {
    throw InputError(request.origin, "the study has several groups; name one with group");
  }
  const std::size_t place =
      request.group.empty() ? 0 : places_of_groups({request.group}, list, request.origin).front();
  const Group& group = list.groups()[place].group();
  const std::string& design = group.design.kind();
  if (design != "saltelli" && design != "morris") {
    throw InputError(request.origin,
                     "a sensitivity needs design.kind = \"saltelli\" or \"morris\", "
                     "and the group has \"" +
                         design + '"');
  }
  for (const Factor& factor : group.factors) {
    if (factor.only.table().empty()) continue;
    throw InputError(factor.origin,
                     "a factor with only is not varied in every cell, as the design " + design +
                         " supposes; leave only out");
  }
  return place;
}

/// Of each replication, cell by cell in the order of the design.
AnswersBySeed answers_of(const StudyResults& results, std::size_t group,
                         const std::string& measure) {
  const TrialGroup& planned = results.list().groups()[group];
  const Question question{measure, "", "", 0.0};
  AnswersBySeed answers(static_cast<std::size_t>(planned.replications()));
  for (int k = 0; k < planned.replications(); ++k) {
    for (std::size_t cell = 0; cell < planned.cells(); ++cell) {
      answers[static_cast<std::size_t>(k)].push_back(
          results.answer(question, results.list().index(group, cell, k)).bounded());
    }
  }
  return answers;
}

/// Their means over replications; missing where that of any replication is.
std::vector<std::optional<double>> means_of(const AnswersBySeed& answers) {
  std::vector<std::optional<double>> means = answers.front();
  for (std::size_t k = 1; k < answers.size(); ++k) {
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
      const std::optional<double>& y = answers[k][cell];
      means[cell] = means[cell] && y ? std::optional(*means[cell] + *y) : std::nullopt;
    }
  }
  for (auto& mean : means) {
    if (mean) *mean /= static_cast<double>(answers.size());
  }
  return means;
}

SaltelliRows saltelli_rows(const TrialGroup& planned) {
  const Setting* second_order = planned.group().design.setting().options().find("second_order");
  return {static_cast<int>(planned.axes().size()),
          second_order != nullptr && std::get<bool>(second_order->value)};
}

std::string note_on_seeds(int seeds) {
  if (seeds == 1) {
    return "Of one seed: what it does together with a factor counts as the factor's. From two "
           "replications on, indices are those of the mean over seeds, from three on with the "
           "scatter of seeds in their intervals.";
  }
  if (seeds == 2) {
    return "Of the mean over 2 seeds; their scatter is not in the intervals, which takes three.";
  }
  return "Of the mean over " + std::to_string(seeds) +
         " seeds; intervals are from resamples of base samples and seeds.";
}

Cell cell_of(const IndexEstimate& estimate) {
  Estimate cell{.value = estimate.value, .digits = Digits::decimals(3)};
  if (estimate.interval)
    cell.uncertainty = Between{estimate.interval->low, estimate.interval->high};
  return cell;
}

Cell text_if_zero(const IndexEstimate& estimate) {
  return std::string(estimate.distinguishable() ? "" : "not distinguishable from 0");
}

/// One row a factor, below those of the measures before.
class IndexTable {
 public:
  IndexTable(const SensitivityRequest& request, const StudyResults& results)
      : request_(request), results_(results), group_(analysed_group(request, results.list())) {}

  std::vector<Table> tables() {
    const bool sobol = planned().group().design.kind() == "saltelli";
    std::vector<Table> tables{sobol ? sobol_table() : morris_table()};
    if (sobol && saltelli_rows(planned()).second_order) tables.push_back(pair_table());
    if (sobol && request_.convergence) tables.push_back(convergence_table());
    return tables;
  }

 private:
  const TrialGroup& planned() const { return results_.list().groups()[group_]; }

  Resampling resampling() const { return {.level = confidence}; }

  std::vector<Cell> row(const std::string& measure, std::size_t factor) const {
    return {heading_of(known_value(measure, request_.origin)), planned().axes()[factor].name()};
  }

  Table sobol_table() const {
    Table table{
        request_.name,
        request_.caption,
        {{.header = "measure"},
         {.header = "factor"},
         {.header = "first order", .name = "first_order"},
         {.header = "", .name = "first_order_note"},
         {.header = "total"},
         {.header = "", .name = "total_note"}},
        {},
        {"First-order (Saltelli) and total (Jansen) indices with 95 % bootstrap intervals. " +
         note_on_seeds(planned().replications())}};
    for (const std::string& measure : request_.measures) {
      const auto answers = answers_of(results_, group_, measure);
      const SobolIndices indices = sobol_indices(answers, saltelli_rows(planned()), resampling());
      for (std::size_t f = 0; f < indices.factors.size(); ++f) {
        std::vector<Cell> cells = row(measure, f);
        cells.push_back(cell_of(indices.factors[f].first_order));
        cells.push_back(text_if_zero(indices.factors[f].first_order));
        cells.push_back(cell_of(indices.factors[f].total));
        cells.push_back(text_if_zero(indices.factors[f].total));
        table.rows.push_back(std::move(cells));
      }
      table.notes.push_back(
          note(measure, indices.base_samples, indices.left_out, "base samples", indices.undefined));
    }
    return table;
  }

  Table pair_table() const {
    Table table{request_.name + "_second_order",
                request_.caption.empty() ? "" : request_.caption + ": pairs of factors",
                {{.header = "measure"},
                 {.header = "factor"},
                 {.header = "and factor", .name = "and_factor"},
                 {.header = "second order", .name = "second_order"},
                 {.header = "", .name = "second_order_note"}},
                {},
                {"What two factors do together, beyond what each does by itself (Saltelli 2002), "
                 "with 95 % bootstrap intervals. " +
                 note_on_seeds(planned().replications())}};
    for (const std::string& measure : request_.measures) {
      const auto answers = answers_of(results_, group_, measure);
      for (const SobolPair& pair :
           sobol_indices(answers, saltelli_rows(planned()), resampling()).pairs) {
        std::vector<Cell> cells = row(measure, static_cast<std::size_t>(pair.first));
        cells.emplace_back(planned().axes()[static_cast<std::size_t>(pair.second)].name());
        cells.push_back(cell_of(pair.index));
        cells.push_back(text_if_zero(pair.index));
        table.rows.push_back(std::move(cells));
      }
    }
    return table;
  }

  Table convergence_table() const {
    Table table{request_.name + "_convergence",
                request_.caption.empty() ? "" : request_.caption + ": convergence",
                {{.header = "measure"},
                 {.header = "factor"},
                 {.header = "base samples", .name = "base_samples"},
                 {.header = "first order", .name = "first_order"},
                 {.header = "total"}},
                {},
                {"Indices that still move from one number of base samples to the next have not "
                 "converged."}};
    for (const std::string& measure : request_.measures) {
      const auto answers = answers_of(results_, group_, measure);
      for (const SobolIndices& indices :
           sobol_convergence(answers, saltelli_rows(planned()), resampling())) {
        for (std::size_t f = 0; f < indices.factors.size(); ++f) {
          std::vector<Cell> cells = row(measure, f);
          cells.emplace_back(Estimate{.value = static_cast<double>(indices.base_samples),
                                      .digits = Digits::decimals(0)});
          cells.push_back(cell_of(indices.factors[f].first_order));
          cells.push_back(cell_of(indices.factors[f].total));
          table.rows.push_back(std::move(cells));
        }
      }
    }
    return table;
  }

  Table morris_table() const {
    Table table{
        request_.name,
        request_.caption,
        {{.header = "measure"},
         {.header = "factor"},
         {.header = "mu"},
         {.header = "mu*", .name = "mu_star"},
         {.header = "sigma"}},
        {},
        {"Elementary effects of a change by the whole range of the factor; mu* with its 95 % "
         "bootstrap interval."}};
    for (const std::string& measure : request_.measures) {
      const MorrisEffects effects = morris_effects(
          planned().design(), means_of(answers_of(results_, group_, measure)), resampling());
      for (std::size_t f = 0; f < effects.factors.size(); ++f) {
        const MorrisEffect& effect = effects.factors[f];
        std::vector<Cell> cells = row(measure, f);
        cells.emplace_back(Estimate{.value = effect.mu, .digits = Digits::significant(3)});
        cells.push_back(cell_of(effect.mu_star));
        cells.push_back(
            effect.sigma ? Cell(Estimate{.value = *effect.sigma, .digits = Digits::significant(3)})
                         : Cell(Missing{}));
        table.rows.push_back(std::move(cells));
      }
      table.notes.push_back(
          note(measure, effects.trajectories, effects.left_out, "trajectories", effects.undefined));
    }
    return table;
  }

  static std::string note(const std::string& measure, int count, int left_out,
                          const std::string& samples, const std::string& undefined) {
    std::string text = measure + ": " + std::to_string(count) + " " + samples;
    if (left_out > 0) {
      text += ", " + std::to_string(left_out) + " left out, of which some answer is missing";
    }
    return text + (undefined.empty() ? "." : "; no indices: " + undefined + ".");
  }

  const SensitivityRequest& request_;
  const StudyResults& results_;
  std::size_t group_;
};

}  // namespace

std::vector<Table> sensitivity_tables(const SensitivityRequest& request,
                                      const StudyResults& results) {
  return IndexTable(request, results).tables();
}

}  // namespace shoal::analysis
