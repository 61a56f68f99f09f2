#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include "shoal/analysis/tables/csv_line.hpp"
#include "shoal/analysis/tables/layout.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

using Fields = std::vector<std::string>;

/// `Energy, mean (Wh)` as `energy_mean_wh`.
std::string snake_case(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%') {
      name += name.ends_with('_') || name.empty() ? "percent" : "_percent";
    } else if (byte >= 128 || std::isalnum(byte) != 0) {
      name += static_cast<char>(byte < 128 ? std::tolower(byte) : byte);
    } else if (!name.empty() && !name.ends_with('_')) {
      name += '_';
    }
  }
  while (name.ends_with('_')) name.pop_back();
  return name;
}

std::string name_of(const Column& column) {
  if (!column.name.empty()) return column.name;
  return snake_case(column.group + " " + column.group_unit + " " + column.header + " " +
                    column.unit);
}

/// What follows the name of the column in the names of an uncertainty's columns.
Fields parts_of(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::plus_minus:
      return {"_plus_minus"};
    case ColumnKind::deviation:
      return {"_sd"};
    case ColumnKind::between:
      return {"_low", "_high"};
    default:
      return {};
  }
}

void add_header(const Column& column, const LaidColumn& laid, Fields& fields) {
  const std::string name = name_of(column);
  fields.push_back(name);
  for (const std::string& part : parts_of(laid.kind)) fields.push_back(name + part);
  if (laid.counts) {
    fields.push_back(name + "_n");
    fields.push_back(name + "_failed");
  }
  if (laid.not_run) fields.push_back(name + "_not_run");
  if (laid.best) fields.push_back(name + "_best");
  if (laid.reached) fields.push_back(name + "_reached");
  if (laid.remarks) fields.push_back(name + "_remarks");
  if (laid.each) fields.push_back(name + "_each");
}

/// A label that a spreadsheet would take for a formula, quoted as spreadsheets do.
std::string without_formula(const std::string& label) {
  const bool is_formula = label.find_first_of("=+-@\t\r") == 0 && !parsed_number(label);
  return is_formula ? "'" + label : label;
}

void add_cell(const Cell& cell, const LaidColumn& laid, Fields& fields) {
  const auto* estimate = std::get_if<Estimate>(&cell);
  const auto* text = std::get_if<std::string>(&cell);
  const auto* missing = std::get_if<Missing>(&cell);
  fields.push_back(text != nullptr       ? without_formula(*text)
                   : estimate != nullptr ? shortest(estimate->value)
                                         : "");
  std::vector<double> parts;
  if (estimate != nullptr) parts = values_of(estimate->uncertainty);
  for (std::size_t k = 0; k < parts_of(laid.kind).size(); ++k) {
    fields.push_back(k < parts.size() ? shortest(parts[k]) : "");
  }
  if (laid.counts) {
    fields.push_back(std::to_string(estimate != nullptr ? estimate->n : 0));
    fields.push_back(std::to_string(estimate != nullptr  ? estimate->failed
                                    : missing != nullptr ? missing->failed
                                                         : 0));
  }
  if (laid.not_run) {
    fields.push_back(std::to_string(estimate != nullptr  ? estimate->not_run
                                    : missing != nullptr ? missing->not_run
                                                         : 0));
  }
  if (laid.best) fields.emplace_back(estimate != nullptr && estimate->best ? "true" : "false");
  if (laid.reached) {
    fields.push_back(estimate != nullptr && estimate->reached ? std::to_string(*estimate->reached)
                                                              : "");
  }
  if (laid.remarks) {
    std::string all;
    for (const std::string& remark : remarks_of(cell)) all += (all.empty() ? "" : " ") + remark;
    fields.push_back(all);
  }
  if (laid.each) {
    std::string all;
    for (const double x : estimate != nullptr ? estimate->each : std::vector<double>{}) {
      all += (all.empty() ? "" : " ") + shortest(x);
    }
    fields.push_back(all);
  }
}

}  // namespace

std::string as_csv(const Table& table) {
  const Layout layout(table);
  Fields header;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    add_header(table.columns[c], layout.columns[c], header);
  }
  if (std::set<std::string>(header.begin(), header.end()).size() < header.size()) {
    throw std::invalid_argument("table \"" + table.name + "\": two columns have the same name");
  }
  std::string printed = csv_line(header);
  for (const std::vector<Cell>& row : table.rows) {
    Fields fields;
    for (std::size_t c = 0; c < row.size(); ++c) add_cell(row[c], layout.columns[c], fields);
    printed += csv_line(fields);
  }
  return printed;
}

}  // namespace shoal::analysis
