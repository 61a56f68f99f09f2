#include "shoal/analysis/tables/checked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace shoal::analysis {
namespace {

[[noreturn]] void refuse(const Table& table, const std::string& why) {
  throw std::invalid_argument(fmt::format("table \"{}\": {}", table.name, why));
}

void check_name(const Table& table) {
  const auto fit = [](unsigned char c) {
    return std::string_view("_.:-").find(static_cast<char>(c)) != std::string_view::npos ||
           (c < 128 && std::isalnum(c) != 0);
  };
  if (!std::ranges::all_of(table.name, fit)) refuse(table, "its name is not fit for a label");
}

void check(const Table& table, const std::string& column, const Estimate& estimate) {
  std::vector<double> numbers = values_of(estimate.uncertainty);
  const auto* between = std::get_if<Between>(&estimate.uncertainty);
  if (between != nullptr && between->low > between->high) {
    refuse(table, "an interval of column \"" + column + "\" has its ends swapped");
  }
  if (between == nullptr && std::ranges::any_of(numbers, [](double x) { return x < 0.0; })) {
    refuse(table, "an uncertainty of column \"" + column + "\" is negative");
  }
  numbers.push_back(estimate.value);
  numbers.insert(numbers.end(), estimate.each.begin(), estimate.each.end());
  if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) {
    refuse(table, "a number of column \"" + column + "\" is not finite");
  }
}

/// Of one cell; nothing for what is missing.
std::optional<ColumnKind> kind_of(const Cell& cell) {
  if (std::holds_alternative<std::string>(cell)) return ColumnKind::text;
  if (const auto* estimate = std::get_if<Estimate>(&cell)) {
    return static_cast<ColumnKind>(static_cast<std::size_t>(ColumnKind::number) +
                                   estimate->uncertainty.index());
  }
  return {};
}

/// A number without its uncertainty (n = 1, say) may stand among others that have one.
std::optional<ColumnKind> common(ColumnKind a, ColumnKind b) {
  if (a == b) return a;
  if (a == ColumnKind::text || b == ColumnKind::text) return {};
  if (a == ColumnKind::number) return b;
  if (b == ColumnKind::number) return a;
  return {};
}

ColumnKind kind_of(const Table& table, std::size_t c) {
  std::optional<ColumnKind> kind;
  for (const std::vector<Cell>& row : table.rows) {
    const std::optional<ColumnKind> here = kind_of(row[c]);
    if (!here) continue;
    kind = kind ? common(*kind, *here) : here;
    if (!kind) refuse(table, "column \"" + table.columns[c].header + "\" mixes kinds of cells");
  }
  return kind.value_or(ColumnKind::text);
}

}  // namespace

std::vector<ColumnKind> checked_kinds(const Table& table) {
  check_name(table);
  if (table.columns.empty()) refuse(table, "it has no columns");
  for (const std::vector<Cell>& row : table.rows) {
    if (row.size() != table.columns.size()) refuse(table, "a row has not a cell for every column");
    for (std::size_t c = 0; c < row.size(); ++c) {
      const auto* estimate = std::get_if<Estimate>(&row[c]);
      if (estimate != nullptr) check(table, table.columns[c].header, *estimate);
      const auto* missing = std::get_if<Missing>(&row[c]);
      if ((estimate != nullptr &&
           (estimate->n < 0 || estimate->failed < 0 || estimate->not_run < 0 ||
            estimate->reached.value_or(0) < 0 || estimate->reached.value_or(0) > estimate->n)) ||
          (missing != nullptr && (missing->failed < 0 || missing->not_run < 0))) {
        refuse(table, "a count of column \"" + table.columns[c].header +
                          "\" is negative, or more than all");
      }
    }
  }
  std::vector<ColumnKind> kinds;
  for (std::size_t c = 0; c < table.columns.size(); ++c) kinds.push_back(kind_of(table, c));
  return kinds;
}

}  // namespace shoal::analysis
