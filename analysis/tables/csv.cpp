#include <algorithm>
#include <cctype>
#include <set>

#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/core/csv_line.hpp"
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

/// The names of what a column of the table takes in CSV.
Fields header_of(const std::string& name, const LaidColumn& laid) {
  Fields fields{name};
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
  return fields;
}

/// Whether a column tells rows apart, and holds no numbers. One whose cells are all missing may be
/// of numbers.
bool has_labels(const Table& table, std::size_t c) {
  return std::ranges::any_of(table.rows, [&](const std::vector<Cell>& row) {
    return std::holds_alternative<std::string>(row[c]);
  });
}

/// Numbers keep their names, for programs that look for them. A factor may have any name, even one
/// of theirs, and labels of levels may differ in signs that names do not have.
std::vector<Fields> distinct_headers(const Table& table, const Layout& layout) {
  std::vector<Fields> headers(table.columns.size());
  std::set<std::string> taken;
  const auto take = [&](std::size_t c, const std::string& clash) {
    const std::string name = name_of(table.columns[c]);
    const auto is_free = [&](const std::string& field) { return !taken.contains(field); };
    const auto try_name = [&](const std::string& ending) {
      headers[c] = header_of(name + ending, layout.columns[c]);
      return std::ranges::all_of(headers[c], is_free);
    };
    if (!try_name("") && !try_name(clash)) {
      for (int k = 2; !try_name(clash + '_' + std::to_string(k));) ++k;
    }
    taken.insert(headers[c].begin(), headers[c].end());
  };
  for (const bool labels : {false, true}) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (has_labels(table, c) == labels) take(c, labels ? "_label" : "");
    }
  }
  return headers;
}

void add_cell(const Cell& cell, const LaidColumn& laid, Fields& fields) {
  const auto* estimate = std::get_if<Estimate>(&cell);
  const auto* text = std::get_if<std::string>(&cell);
  const auto* missing = std::get_if<Missing>(&cell);
  fields.push_back(text != nullptr ? *text : estimate != nullptr ? shortest(estimate->value) : "");
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
  for (const Fields& fields : distinct_headers(table, layout)) {
    header.insert(header.end(), fields.begin(), fields.end());
  }
  std::string printed = csv_line(header);
  for (const std::vector<Cell>& row : table.rows) {
    Fields fields;
    for (std::size_t c = 0; c < row.size(); ++c) add_cell(row[c], layout.columns[c], fields);
    printed += csv_line(fields);
  }
  return printed;
}

namespace {

struct InCsv final : TableFormat {
  std::string print(const Table& table) const override { return as_csv(table); }
  std::string file_ending() const override { return ".csv"; }

  static void declare(Options<InCsv>&) {}
};

const Register<TableFormat, InCsv> registered{
    "csv", "comma-separated values (RFC 4180), numbers in full precision"};

}  // namespace
}  // namespace shoal::analysis
