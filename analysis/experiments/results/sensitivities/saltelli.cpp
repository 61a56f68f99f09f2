#include "shoal/analysis/experiments/results/sensitivity_analysis.hpp"

namespace shoal::analysis {
namespace {

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

Cell text_if_zero(const IndexEstimate& estimate) {
  return std::string(estimate.distinguishable() ? "" : "not distinguishable from 0");
}

Table sobol_table(const AnalysedGroup& group) {
  Table table{group.request().name,
              group.request().caption,
              {{.header = "measure"},
               {.header = "factor"},
               {.header = "first order", .name = "first_order"},
               {.header = "", .name = "first_order_note"},
               {.header = "total"},
               {.header = "", .name = "total_note"}},
              {},
              {"First-order (Saltelli) and total (Jansen) indices with 95 % bootstrap intervals. " +
               note_on_seeds(group.planned().replications())}};
  for (const std::string& measure : group.request().measures) {
    const auto answers = group.answers(measure);
    const SobolIndices indices =
        sobol_indices(answers, saltelli_rows(group.planned()), AnalysedGroup::resampling());
    for (std::size_t f = 0; f < indices.factors.size(); ++f) {
      std::vector<Cell> cells = group.row(measure, f);
      cells.push_back(cell_of(indices.factors[f].first_order));
      cells.push_back(text_if_zero(indices.factors[f].first_order));
      cells.push_back(cell_of(indices.factors[f].total));
      cells.push_back(text_if_zero(indices.factors[f].total));
      table.rows.push_back(std::move(cells));
    }
    table.notes.push_back(note_on_samples(measure, indices.base_samples, indices.left_out,
                                          "base samples", indices.undefined));
  }
  return table;
}

Table pair_table(const AnalysedGroup& group) {
  Table table{group.request().name + "_second_order",
              group.request().caption.empty() ? "" : group.request().caption + ": pairs of factors",
              {{.header = "measure"},
               {.header = "factor"},
               {.header = "and factor", .name = "and_factor"},
               {.header = "second order", .name = "second_order"},
               {.header = "", .name = "second_order_note"}},
              {},
              {"What two factors do together, beyond what each does by itself (Saltelli 2002), "
               "with 95 % bootstrap intervals. " +
               note_on_seeds(group.planned().replications())}};
  for (const std::string& measure : group.request().measures) {
    const auto answers = group.answers(measure);
    for (const SobolPair& pair :
         sobol_indices(answers, saltelli_rows(group.planned()), AnalysedGroup::resampling())
             .pairs) {
      std::vector<Cell> cells = group.row(measure, static_cast<std::size_t>(pair.first));
      cells.emplace_back(group.planned().axes()[static_cast<std::size_t>(pair.second)].name());
      cells.push_back(cell_of(pair.index));
      cells.push_back(text_if_zero(pair.index));
      table.rows.push_back(std::move(cells));
    }
  }
  return table;
}

Table convergence_table(const AnalysedGroup& group) {
  Table table{group.request().name + "_convergence",
              group.request().caption.empty() ? "" : group.request().caption + ": convergence",
              {{.header = "measure"},
               {.header = "factor"},
               {.header = "base samples", .name = "base_samples"},
               {.header = "first order", .name = "first_order"},
               {.header = "total"}},
              {},
              {"Indices that still move from one number of base samples to the next have not "
               "converged."}};
  for (const std::string& measure : group.request().measures) {
    const auto answers = group.answers(measure);
    for (const SobolIndices& indices :
         sobol_convergence(answers, saltelli_rows(group.planned()), AnalysedGroup::resampling())) {
      for (std::size_t f = 0; f < indices.factors.size(); ++f) {
        std::vector<Cell> cells = group.row(measure, f);
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

/// Sobol' indices of the mean over seeds: those of pairs too, if there are their cells, and how
/// they converge.
struct SobolTables final : SensitivityAnalysis {
  std::vector<Table> tables(const AnalysedGroup& group) const override {
    std::vector<Table> tables{sobol_table(group)};
    if (saltelli_rows(group.planned()).second_order) tables.push_back(pair_table(group));
    if (group.request().convergence) tables.push_back(convergence_table(group));
    return tables;
  }

  static void declare(Options<SobolTables>&) {}
};

const Register<SensitivityAnalysis, SobolTables> registered{
    "saltelli", "Sobol' indices, and how they converge (Saltelli et al. 2010)"};

}  // namespace
}  // namespace shoal::analysis
