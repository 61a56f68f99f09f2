#include "shoal/analysis/study/difference_table.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/analysis/measure.hpp"
#include "shoal/analysis/statistics/effect_size.hpp"
#include "shoal/analysis/statistics/holm.hpp"
#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/study/cells.hpp"
#include "shoal/analysis/study/confidence.hpp"
#include "shoal/analysis/study/paired_test.hpp"
#include "shoal/analysis/study/slices.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

constexpr int most_replications = 10000;

Cell number(const std::optional<double>& value, Digits digits) {
  if (!value) return Missing{};
  return Estimate{.value = *value, .digits = digits};
}

Cell difference_cell(const std::vector<double>& differences, int failed) {
  return cell_of(differences, failed, Statistic::mean_ci);
}

Cell replications_cell(const std::vector<double>& differences, double wanted) {
  if (!statistics::standard_error(differences) || wanted == 0.0) return Missing{};
  const auto n = statistics::replications_for(wanted, statistics::standard_deviation(differences),
                                              1.0 - confidence, wanted_power, most_replications);
  if (!n) return Missing{};
  return Estimate{.value = static_cast<double>(*n), .digits = Digits::decimals(0)};
}

}  // namespace

Table difference_table(const ComparisonRequest& request, const StudyResults& results) {
  const Slices slices(
      results,
      {request.groups, CellSelection(request.where), {request.factor}, {}, true, request.origin});
  const Dimension& compared = slices.dimensions().front();
  const auto reference = std::ranges::find(compared.labels, request.reference);
  if (reference == compared.labels.end()) {
    throw InputError(request.origin, "the factor " + request.factor + " has no level \"" +
                                         request.reference + '"' +
                                         suggestion(request.reference, compared.labels));
  }
  Table table{request.name, request.caption, {}, {}, {}};
  for (std::size_t d = 1; d < slices.dimensions().size(); ++d) {
    table.columns.push_back(
        {.header = slices.dimensions()[d].name, .unit = slices.dimensions()[d].unit});
  }
  table.columns.push_back({.header = "metric"});
  table.columns.push_back({.header = compared.name});
  table.columns.push_back({.header = "difference"});
  table.columns.push_back({.header = "p", .name = "p_value"});
  table.columns.push_back({.header = "effect", .name = "hedges_g_z"});
  table.columns.push_back({.header = "rank", .name = "rank_biserial"});
  table.columns.push_back({.header = "needed", .name = "replications_needed"});

  std::vector<std::vector<double>> samples;  // of each row
  for (const std::string& metric : request.metrics) {
    const Quantity& quantity = known_value(metric, request.origin);
    const Question question{metric, "", "", 0.0};
    for (std::vector<std::size_t> place : slices.places()) {
      if (compared.labels[place[0]] == request.reference) continue;
      const std::size_t own = place[0];
      const Sample sample = slices.sample(place, question);
      place[0] = static_cast<std::size_t>(reference - compared.labels.begin());
      if (!slices.has(place)) continue;  // the reference was not run with these other labels
      const Sample other = slices.sample(place, question);
      const std::vector<double> differences = sample.minus(other);

      std::vector<Cell> row;
      for (std::size_t d = 1; d < place.size(); ++d) {
        row.push_back(label_cells(slices.dimensions()[d].labels)[place[d]]);
      }
      row.emplace_back(heading_of(quantity) +
                       (quantity.unit.empty() ? "" : " (" + quantity.unit + ")"));
      row.emplace_back(compared.labels[own]);
      row.push_back(difference_cell(differences, sample.failed + other.failed));
      row.emplace_back(Missing{});  // p, once all are known
      row.push_back(number(statistics::hedges_g_z(differences), Digits::decimals(2)));
      row.push_back(
          number(statistics::rank_biserial_correlation(differences), Digits::decimals(2)));
      const double wanted = other.values.empty() ? 0.0
                                                 : std::abs(statistics::mean(other.values)) *
                                                       request.resolve_percent / 100.0;
      row.push_back(replications_cell(differences, wanted));
      table.rows.push_back(std::move(row));
      samples.push_back(differences);
    }
  }
  std::vector<double> p_values;
  std::vector<std::size_t> tested;  // the row of each
  const auto answers = paired_p_values(samples, request.test);
  for (std::size_t row = 0; row < answers.size(); ++row) {
    if (!answers[row]) continue;
    p_values.push_back(*answers[row]);
    tested.push_back(row);
  }
  const std::vector<double> adjusted = statistics::holm(p_values);
  const std::size_t p_column = table.columns.size() - 4;
  for (std::size_t k = 0; k < tested.size(); ++k) {
    table.rows[tested[k]][p_column] = number(adjusted[k], Digits::significant(2));
  }
  table.notes.push_back("Differences from " + request.reference +
                        ", seed by seed: mean and half the 95 % confidence interval (Student).");
  table.notes.push_back(
      "p: " + std::string(name_of(request.test)) +
      " test, corrected by Holm over the table. effect: mean / standard deviation "
      "(Hedges' g_z); rank: rank-biserial correlation.");
  table.notes.push_back("needed: replications that show a difference of " +
                        shortest(request.resolve_percent) + " % of the mean of " +
                        request.reference +
                        " with a chance of 80 %; a dash where 10,000 would not.");
  return table;
}

}  // namespace shoal::analysis
