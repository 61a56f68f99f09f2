#include "shoal/analysis/experiments/results/cell_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/results/paired_test.hpp"
#include "shoal/analysis/experiments/results/shape_remark.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/analysis/statistics/holm.hpp"
#include "shoal/analysis/statistics/sample.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

constexpr std::size_t most_steps = 100000;

using Place = std::vector<std::size_t>;

/// A request laid out: which dimension of the slices runs where.
class CellTable {
 public:
  CellTable(const TableRequest& request, const StudyResults& results)
      : request_(request),
        statistic_(Choice<Statistic>(request.statistic).make()),
        test_(Choice<PairedTest>(request.test).make()),
        results_(results),
        slices_(results, scope_of(request)) {
    // Kept dimensions come as named: columns first, then rows, then what was not named.
    columns_ = request.columns.size();
    for (const std::string& name : request.measures)
      quantities_.push_back(known_value(name, request.origin));
    for (const std::string& name : request.series)
      quantities_.push_back(known_series(name, request.origin));
    for (std::size_t d = 0; d < slices_.dimensions().size(); ++d) {
      if (slices_.dimensions()[d].name == request.compare) compare_ = d;
    }
    if (!request.compare.empty() && !compare_) {
      throw InputError(request.origin, "compare names \"" + request.compare +
                                           "\", which is neither in rows nor in columns");
    }
    find_steps();
  }

  Table table() {
    Table table{request_.name, request_.caption, {}, {}, {}};
    const std::vector<Place> across = places(0, columns_);
    const std::vector<Place> down = places(columns_, slices_.dimensions().size());
    head(table, across);
    find_best();
    for (const Place& row : down) {
      for (std::size_t step = 0; step < steps(); ++step) {
        std::vector<Cell> cells;
        for (std::size_t k = 0; k < row.size(); ++k) {
          const auto& labels = slices_.dimensions()[columns_ + k].labels;
          cells.push_back(label_cells(labels)[row[k]]);
        }
        if (!request_.series.empty()) {
          cells.emplace_back(Estimate{.value = at(step), .digits = Digits::significant(9)});
        }
        bool any = false;
        for (const Place& column : across) {
          for (std::size_t q = 0; q < quantities_.size(); ++q) {
            cells.push_back(cell(joined(column, row), q, step));
            any |= !std::holds_alternative<Missing>(cells.back()) ||
                   std::get<Missing>(cells.back()).failed > 0 ||
                   std::get<Missing>(cells.back()).not_run > 0;
          }
        }
        // Rows of combinations that the study excludes, and of times that no trial reached, say
        // nothing.
        if (any) table.rows.push_back(std::move(cells));
      }
    }
    add_notes(table);
    return table;
  }

 private:
  static Scope scope_of(const TableRequest& request) {
    Scope scope{request.groups, CellSelection(request.where), request.columns,
                request.pool,   request.rows.empty(),         request.origin};
    scope.kept.insert(scope.kept.end(), request.rows.begin(), request.rows.end());
    std::set<std::string> once(scope.kept.begin(), scope.kept.end());
    if (once.size() != scope.kept.size()) {
      throw InputError(request.origin, "a factor stands twice in rows and columns");
    }
    return scope;
  }

  /// Rows of a table of series: up to the last value that any trial has.
  void find_steps() {
    if (request_.series.empty()) return;
    double last = 0.0;
    const std::string& axis = request_.against.empty() ? request_.series.front() : request_.against;
    for (std::size_t i = 0; i < results_.list().trials(); ++i) {
      const scenarios::Series* s = results_.series(axis, i);
      if (!s || s->time_s.empty()) continue;
      last = std::max(last, request_.against.empty() ? s->time_s.back() : s->values.back());
    }
    const double count = std::floor(last / request_.every * (1.0 + 1e-12)) + 1.0;
    if (count > static_cast<double>(most_steps)) {
      throw InputError(request_.origin, "every = " + shortest(request_.every) +
                                            " gives more than 100,000 rows; take larger steps");
    }
    steps_ = static_cast<std::size_t>(count);
  }

  std::size_t steps() const { return steps_; }
  double at(std::size_t step) const { return request_.every * static_cast<double>(step); }

  Question question(std::size_t quantity, std::size_t step) const {
    if (request_.series.empty()) return {quantities_[quantity].name, "", "", 0.0};
    return {"", quantities_[quantity].name, request_.against, at(step)};
  }

  /// The labels that occur together in dimensions [first, last).
  std::vector<Place> places(std::size_t first, std::size_t last) const {
    std::set<Place> found;
    for (const Place& place : slices_.places()) {
      found.emplace(place.begin() + static_cast<std::ptrdiff_t>(first),
                    place.begin() + static_cast<std::ptrdiff_t>(last));
    }
    return {found.begin(), found.end()};
  }

  static Place joined(Place column, const Place& row) {
    column.insert(column.end(), row.begin(), row.end());
    return column;
  }

  Cell cell(const Place& place, std::size_t quantity, std::size_t step) {
    const Sample sample = slices_.sample(place, question(quantity, step));
    Cell cell = cell_of(sample, *statistic_);
    if (auto* estimate = std::get_if<Estimate>(&cell)) {
      estimate->best = best_.contains({place, quantity, step});
      if (sample.times && statistic_->is_of_values()) {
        events_ = true;
        if (std::isfinite(sample.horizon())) horizons_.insert(sample.horizon());
      }
      ++cells_;
      const auto said = statistic_->is_of_values()
                            ? remark_on_shape(sample.restricted(sample.horizon()))
                            : std::nullopt;
      if (said) ++remarked_;
      // Against time, marks and points would be more than one could read.
      if (said && request_.series.empty()) estimate->remarks.push_back(*said);
      if (!request_.series.empty()) estimate->each.clear();
    }
    return cell;
  }

  /// `period 15 s`, of a factor whose level is a number.
  static std::string quantified(const Dimension& dimension, const std::string& number) {
    const std::string name = heading_of({dimension.name, dimension.unit, ""});
    return name + " " + number + (dimension.unit.empty() ? "" : " " + dimension.unit);
  }

  void head(Table& table, const std::vector<Place>& across) const {
    const auto& dimensions = slices_.dimensions();
    for (std::size_t d = columns_; d < dimensions.size(); ++d) {
      table.columns.push_back({.header = dimensions[d].name, .unit = dimensions[d].unit});
    }
    if (!request_.series.empty()) {
      const Quantity axis = request_.against.empty()
                                ? Quantity{"time_s", "s", ""}
                                : known_series(request_.against, request_.origin);
      table.columns.push_back({.header = heading_of(axis), .unit = axis.unit, .name = axis.name});
    }
    for (const Place& place : across) {
      std::string labels, spelled, name;
      for (std::size_t d = 0; d < columns_; ++d) {
        const std::string& label = dimensions[d].labels[place[d]];
        labels += (d ? ", " : "") + label;
        // A word speaks for itself; a number is one of something.
        spelled += d ? ", " : "";
        spelled += parsed_number(label) ? quantified(dimensions[d], label) : label;
        name += label + "_";
      }
      for (const Quantity& quantity : quantities_) {
        Column column{
            .header = heading_of(quantity), .unit = quantity.unit, .name = name + quantity.name};
        if (columns_ > 0 && quantities_.size() == 1) {
          column.header = labels;
          column.unit = "";
          column.group = dimensions[0].name;
          column.group_unit = dimensions[0].unit;
          for (std::size_t d = 1; d < columns_; ++d) column.group += ", " + dimensions[d].name;
        } else if (columns_ > 0) {
          column.group = spelled;
        }
        table.columns.push_back(std::move(column));
      }
    }
  }

  /// In every comparison of levels, the best one if a test tells it from each of the others; all
  /// tests of the table are one family (Holm 1979).
  void find_best() {
    if (!compare_) return;
    struct Contest {
      Place best;
      std::size_t quantity, step, first_test, tests;
    };
    std::vector<Contest> contests;
    std::vector<statistics::Differences> differences;  // of each test
    std::set<Place> seen;
    for (const Place& place : slices_.places()) {
      Place others = place;
      others[*compare_] = 0;
      if (!seen.insert(others).second) continue;
      for (std::size_t q = 0; q < quantities_.size(); ++q) {
        for (std::size_t step = 0; step < steps(); ++step) {
          std::vector<std::pair<Place, Sample>> rivals;
          for (std::size_t l = 0; l < slices_.dimensions()[*compare_].labels.size(); ++l) {
            others[*compare_] = l;
            Sample sample = slices_.sample(others, question(q, step));
            if (!sample.values.empty()) rivals.emplace_back(others, std::move(sample));
          }
          if (rivals.size() < 2) continue;
          const double sign = request_.best == Best::lowest ? 1.0 : -1.0;
          const auto best = std::ranges::min_element(rivals, {}, [&](const auto& rival) {
            const Sample& sample = rival.second;
            return sign * statistics::mean(sample.restricted(sample.horizon()));
          });
          contests.push_back({best->first, q, step, differences.size(), rivals.size() - 1});
          for (auto rival = rivals.begin(); rival != rivals.end(); ++rival) {
            if (rival != best) differences.push_back(best->second.minus(rival->second));
          }
        }
      }
    }
    std::vector<double> p_values;
    for (const std::optional<double>& p : paired_p_values(differences, *test_)) {
      p_values.push_back(p.value_or(1.0));
    }
    const std::vector<double> adjusted = statistics::holm(p_values);
    floor_ = note_on_floor(differences, *test_);
    for (const Contest& contest : contests) {
      const auto first = adjusted.begin() + static_cast<std::ptrdiff_t>(contest.first_test);
      const bool known = std::all_of(first, first + static_cast<std::ptrdiff_t>(contest.tests),
                                     [](double p) { return p <= significance; });
      if (known) best_.insert({contest.best, contest.quantity, contest.step});
    }
  }

  void add_notes(Table& table) const {
    std::string notes = statistic_->note();
    if (columns_ > 0 && quantities_.size() == 1) {
      const Quantity& quantity = quantities_.front();
      notes = quantity.name + ": " + quantity.meaning +
              (quantity.unit.empty() ? "" : ", in " + quantity.unit) + ". " + notes;
    }
    table.notes.push_back(notes);
    if (compare_) {
      table.notes.push_back(
          "Best: " + std::string(request_.best == Best::lowest ? "the lowest" : "the highest") +
          " mean over " + request_.compare + ", where a " + test_->title() +
          " test of paired differences, corrected by Holm over the table, tells it "
          "from all others at 5 %.");
      if (floor_) table.notes.push_back(*floor_);
    }
    if (events_) {
      table.notes.push_back(horizons_.empty()
                                ? "Times to an event: means; all trials saw it."
                                : "Times to an event: restricted means" + horizon_text() +
                                      ", at which trials count that never saw it; in brackets, how "
                                      "many did.");
    }
    if (remarked_ > 0 && request_.series.empty()) table.notes.push_back(note_on_shapes());
    if (remarked_ > 0 && !request_.series.empty()) {
      table.notes.push_back(fmt::format(
          "Of {} cells, {} are not of one symmetric kind (dip test and skewness, each at 1 %).",
          cells_, remarked_));
    }
  }

  /// Up to when.
  std::string horizon_text() const {
    if (horizons_.size() > 1) return ", up to the end of each cell's watch";
    return " up to " + shortest(*horizons_.begin()) + " s";
  }

  const TableRequest& request_;
  std::unique_ptr<Statistic> statistic_;
  std::unique_ptr<PairedTest> test_;
  const StudyResults& results_;
  Slices slices_;
  std::size_t columns_ = 0;
  std::vector<Quantity> quantities_;
  std::optional<std::size_t> compare_;
  std::size_t steps_ = 1;
  std::set<std::tuple<Place, std::size_t, std::size_t>> best_;
  std::optional<std::string> floor_;  ///< what the tests for the best can show
  bool events_ = false;
  std::set<double> horizons_;
  int cells_ = 0, remarked_ = 0;
};

}  // namespace

Table cell_table(const TableRequest& request, const StudyResults& results) {
  return CellTable(request, results).table();
}

}  // namespace shoal::analysis
