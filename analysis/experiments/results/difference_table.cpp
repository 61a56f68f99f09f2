#include "shoal/analysis/experiments/results/difference_table.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/results/paired_test.hpp"
#include "shoal/analysis/experiments/results/shape_remark.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/analysis/statistics/effect_size.hpp"
#include "shoal/analysis/statistics/holm.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/statistics/survival.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

constexpr int most_replications = 10000;

Cell number_or_missing(const std::optional<double>& value, Digits digits) {
  if (!value) return Missing{};
  return Estimate{.value = *value, .digits = digits};
}

/// One comparison: a level, in one place of the table, with the reference there.
struct Compared {
  std::vector<Cell> labels;
  Sample ours, theirs;
  statistics::Differences differences;
};

class DifferenceTable {
 public:
  DifferenceTable(const ComparisonRequest& request, const StudyResults& results)
      : request_(request), test_(Choice<PairedTest>(request.test).make()), other_(test_->beside()) {
    find_rows(Slices(results, {request.groups,
                               CellSelection(request.where),
                               {request.factor},
                               {},
                               true,
                               request.origin}));
    tested_ = static_cast<double>(
        std::ranges::count_if(rows_, [](const Compared& row) { return !row.differences.empty(); }));
    times_ = std::ranges::any_of(rows_, [](const Compared& row) { return row.ours.times; });
  }

  Table table() {
    Table table{request_.name, request_.caption, head_, {}, {}};
    for (const Compared& row : rows_) table.rows.push_back(row.labels);
    add(table, {.header = "difference"}, [&](const Compared& row) { return difference(row); });
    add_p_values(table, {.header = "p", .name = "p_value"}, *test_);
    add_p_values(table,
                 {.header = "p (" + other_->short_title() + ")",
                  .name = "p_value_" + other_->column_ending()},
                 *other_);
    if (times_) add_log_ranks(table);
    add(table, {.header = "effect", .name = "hedges_g_z"}, [&](const Compared& row) {
      return number_or_missing(statistics::hedges_g_z(row.differences), Digits::decimals(2));
    });
    add(table, {.header = "rank", .name = "rank_biserial"}, [&](const Compared& row) {
      return number_or_missing(statistics::rank_biserial_correlation(row.differences),
                               Digits::decimals(2));
    });
    add_needed(table, {.header = "needed", .name = "replications_needed"}, *test_);
    add_needed(table,
               {.header = "needed (" + other_->short_title() + ")",
                .name = "replications_needed_" + other_->column_ending()},
               *other_);
    add_notes(table);
    return table;
  }

 private:
  void find_rows(const Slices& slices) {
    const Dimension& compared = slices.dimensions().front();
    const auto reference = std::ranges::find(compared.labels, request_.reference);
    if (reference == compared.labels.end()) {
      throw InputError(request_.origin, "the factor " + request_.factor + " has no level \"" +
                                            request_.reference + '"' +
                                            suggestion(request_.reference, compared.labels));
    }
    for (std::size_t d = 1; d < slices.dimensions().size(); ++d) {
      head_.push_back({.header = slices.dimensions()[d].name, .unit = slices.dimensions()[d].unit});
    }
    head_.push_back({.header = "measure"});
    head_.push_back({.header = compared.name});
    for (const std::string& measure : request_.measures) {
      const Quantity& quantity = known_value(measure, request_.origin);
      const Question question{measure, "", "", 0.0};
      for (std::vector<std::size_t> place : slices.places()) {
        if (compared.labels[place[0]] == request_.reference) continue;
        const std::size_t own = place[0];
        Compared row;
        row.ours = slices.sample(place, question);
        place[0] = static_cast<std::size_t>(reference - compared.labels.begin());
        if (!slices.has(place)) continue;  // the reference was not run with these other labels
        row.theirs = slices.sample(place, question);
        row.differences = row.ours.minus(row.theirs);
        for (std::size_t d = 1; d < place.size(); ++d) {
          row.labels.push_back(label_cells(slices.dimensions()[d].labels)[place[d]]);
        }
        row.labels.emplace_back(heading_of(quantity) +
                                (quantity.unit.empty() ? "" : " (" + quantity.unit + ")"));
        row.labels.emplace_back(compared.labels[own]);
        rows_.push_back(std::move(row));
      }
    }
  }

  template <class Of>
  void add(Table& table, const Column& column, const Of& of) const {
    table.columns.push_back(column);
    for (std::size_t i = 0; i < rows_.size(); ++i) table.rows[i].push_back(of(rows_[i]));
  }

  /// Numbers of all rows that have one, corrected by Holm over them.
  template <class Remark>
  void add_corrected(Table& table, const Column& column,
                     const std::vector<std::optional<double>>& p_values,
                     const Remark& remark) const {
    std::vector<double> known;
    for (const std::optional<double>& p : p_values) {
      if (p) known.push_back(*p);
    }
    const std::vector<double> adjusted = statistics::holm(known);
    table.columns.push_back(column);
    std::size_t next = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!p_values[i]) {
        table.rows[i].emplace_back(Missing{});
        continue;
      }
      Estimate cell{.value = adjusted[next++], .digits = Digits::significant(2)};
      if (const auto said = remark(i, *p_values[i])) cell.remarks.push_back(*said);
      table.rows[i].emplace_back(std::move(cell));
    }
  }

  void add_p_values(Table& table, const Column& column, const PairedTest& test) const {
    add_corrected(table, column, paired_p_values(differences(), test),
                  [&](std::size_t i, double p) -> std::optional<std::string> {
                    if (!at_floor(p, rows_[i].differences, test)) return std::nullopt;
                    return fmt::format("The least p that these {} differences can give.",
                                       rows_[i].differences.size());
                  });
  }

  void add_log_ranks(Table& table) const {
    std::vector<std::optional<double>> p_values;
    for (const Compared& row : rows_) {
      p_values.emplace_back();
      if (!row.ours.times) continue;
      const auto result =
          statistics::log_rank(std::vector{row.ours.event_times(), row.theirs.event_times()});
      if (result) p_values.back() = result->p_value;
    }
    add_corrected(table, {.header = "p (log-rank)", .name = "p_value_log_rank"}, p_values,
                  [](std::size_t, double) { return std::optional<std::string>(); });
  }

  static Cell difference(const Compared& row) {
    Cell cell = Missing{};
    if (!row.differences.empty()) cell = mean_with_interval(row.differences.values());
    const int failed = row.ours.failed + row.theirs.failed;
    const int not_run = row.ours.not_run + row.theirs.not_run;
    auto* estimate = std::get_if<Estimate>(&cell);
    if (!estimate) return Missing{failed, not_run};
    estimate->failed = failed;
    estimate->not_run = not_run;
    if (!row.differences.standard_error()) {  // it scatters by rounding only
      estimate->uncertainty = std::monostate{};
      estimate->digits = Digits::significant(4);
    }
    if (const auto said = remark_on_shape(row.differences.values())) {
      estimate->remarks.push_back(*said);
    }
    if (row.ours.waits) {
      estimate->remarks.push_back(fmt::format("Reached by {} of {}, and by {} of {} of {}.",
                                              *row.ours.reached_count(), row.ours.values.size(),
                                              *row.theirs.reached_count(), row.theirs.values.size(),
                                              "the others"));
    }
    return cell;
  }

  void add_needed(Table& table, const Column& column, const PairedTest& test) const {
    std::vector<Cell> needed(rows_.size(), Missing{});
    tbb::parallel_for(std::size_t{0}, rows_.size(), [&](std::size_t i) {
      const Compared& row = rows_[i];
      if (row.differences.size() < 2) return;
      const double wanted =
          std::abs(statistics::mean(row.theirs.values)) * request_.resolve_percent / 100.0;
      if (wanted == 0.0) return;
      // Without scatter, a difference of any size would show.
      const double effect = row.differences.standard_error()
                                ? wanted / statistics::standard_deviation(row.differences.values())
                                : std::numeric_limits<double>::infinity();
      const auto n = statistics::replications_for(test, effect, significance / tested_,
                                                  wanted_power, most_replications);
      if (n) needed[i] = Estimate{.value = static_cast<double>(*n), .digits = Digits::decimals(0)};
    });
    table.columns.push_back(column);
    for (std::size_t i = 0; i < rows_.size(); ++i) table.rows[i].push_back(std::move(needed[i]));
  }

  std::vector<statistics::Differences> differences() const {
    std::vector<statistics::Differences> all;
    for (const Compared& row : rows_) all.push_back(row.differences);
    return all;
  }

  void add_notes(Table& table) const {
    table.notes.push_back("Differences from " + request_.reference +
                          ", seed by seed: mean and half the 95 % confidence interval (Student).");
    table.notes.push_back(fmt::format(
        "p: {} test, p ({}): {} test, both corrected by Holm over the table. effect: mean / "
        "standard deviation (Hedges' g_z); rank: rank-biserial correlation.",
        test_->title(), other_->short_title(), other_->title()));
    for (const PairedTest* each : {test_.get(), other_.get()}) {
      if (const auto note = note_on_floor(differences(), *each)) table.notes.push_back(*note);
    }
    table.notes.push_back(fmt::format(
        "needed: replications with which the {} test (and the {} test) would show a difference of "
        "{} % of the mean of {} with a chance of 80 %, at 5 %{}; a dash where 10,000 would not.",
        test_->title(), other_->title(), shortest(request_.resolve_percent), request_.reference,
        tested_ > 1.0 ? fmt::format(" corrected for all {:.0f} comparisons", tested_) : ""));
    if (times_) table.notes.push_back(note_on_events());
    const bool remarked = std::ranges::any_of(rows_, [](const Compared& row) {
      return remark_on_shape(row.differences.values()).has_value();
    });
    if (remarked) table.notes.push_back(note_on_shapes());
  }

  const ComparisonRequest& request_;
  std::unique_ptr<PairedTest> test_, other_;
  std::vector<Column> head_;
  std::vector<Compared> rows_;
  double tested_ = 0.0;
  bool times_ = false;
};

}  // namespace

Table difference_table(const ComparisonRequest& request, const StudyResults& results) {
  return DifferenceTable(request, results).table();
}

}  // namespace shoal::analysis
