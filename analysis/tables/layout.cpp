#include "shoal/analysis/tables/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "shoal/analysis/tables/checked.hpp"

namespace shoal::analysis {
namespace {

/// How many values an estimate has, and how many trials failed, or have not run.
struct Counts {
  int n = 0, failed = 0, not_run = 0;

  auto operator<=>(const Counts&) const = default;
  bool known() const { return n > 0 || failed > 0 || not_run > 0; }

  std::string text() const {
    if (n == 0 && not_run == 0) {
      return failed == 1 ? "the only trial failed" : fmt::format("all {} failed", failed);
    }
    return fmt::format("n = {}", n) + (failed > 0 ? fmt::format(", {} failed", failed) : "") +
           (not_run > 0 ? fmt::format(", {} not run", not_run) : "");
  }
};

Counts counts_of(const Cell& cell) {
  if (const auto* estimate = std::get_if<Estimate>(&cell)) {
    return {estimate->n, estimate->failed, estimate->not_run};
  }
  if (const auto* missing = std::get_if<Missing>(&cell)) {
    return {0, missing->failed, missing->not_run};
  }
  return {};
}

/// a, b, ... z, aa, ab ...
std::string letters(std::size_t k) {
  const std::string last(1, static_cast<char>('a' + k % 26));
  return k < 26 ? last : letters(k / 26 - 1) + last;
}

/// Says once what most estimates have, and gives a mark to the others, and to those of which more
/// is to say.
void mark_counts(const Table& table, Layout& layout) {
  std::map<Counts, int> times;
  for (const auto& row : table.rows) {
    for (const Cell& cell : row) {
      if (counts_of(cell).known()) ++times[counts_of(cell)];
    }
  }
  // Failures are always marked. Of two n that are as frequent, the greater is the usual one.
  std::optional<Counts> usual;
  for (const auto& [counts, many] : times) {
    if (counts.failed == 0 && counts.not_run == 0 && (!usual || many >= times.at(*usual)))
      usual = counts;
  }
  if (usual) {
    layout.notes.push_back(
        {"", usual->text() + (times.size() == 1 ? " throughout" : " unless marked") + "."});
  }
  std::map<std::string, std::string> marks;  // of what is said
  const auto mark = [&](LaidCell& cell, const std::string& said) {
    const auto [found, is_new] = marks.try_emplace(said, letters(marks.size()));
    if (is_new) layout.notes.push_back({found->second, said});
    cell.mark += (cell.mark.empty() ? "" : ",") + found->second;
  };
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const Counts counts = counts_of(table.rows[r][c]);
      if (counts.known() && counts != usual) mark(layout.rows[r][c], counts.text() + ".");
      for (const std::string& remark : remarks_of(table.rows[r][c]))
        mark(layout.rows[r][c], remark);
    }
  }
}

std::vector<Span> spans_of(const std::vector<Column>& columns) {
  std::vector<Span> spans;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Column& column = columns[c];
    if (column.group.empty()) continue;
    const bool goes_on = !spans.empty() && spans.back().first + spans.back().count == c &&
                         spans.back().header == column.group &&
                         spans.back().unit == column.group_unit;
    if (!goes_on) spans.push_back({column.group, column.group_unit, c, 0});
    ++spans.back().count;
  }
  return spans;
}

/// What is known of a column once all its cells are.
LaidColumn laid(const Table& table, const Layout& layout, std::size_t c, ColumnKind kind) {
  LaidColumn column{.kind = kind};
  for (const auto& row : table.rows) {
    column.counts = column.counts || counts_of(row[c]).known();
    column.not_run = column.not_run || counts_of(row[c]).not_run > 0;
    column.remarks = column.remarks || !remarks_of(row[c]).empty();
    const auto* estimate = std::get_if<Estimate>(&row[c]);
    if (estimate == nullptr) continue;
    column.each = column.each || !estimate->each.empty();
    column.reached = column.reached || estimate->reached;
    column.best = column.best || estimate->best;
    if (estimate->digits.count == Digits::Count::significant) column.at_point = false;
  }
  for (const auto& row : layout.rows) {
    for (std::size_t k = 0; k < row[c].numbers.size(); ++k) {
      const Extent extent = Layout::extent_of(row[c].numbers[k], column.at_point);
      column.extents[k].before = std::max(column.extents[k].before, extent.before);
      column.extents[k].after = std::max(column.extents[k].after, extent.after);
    }
  }
  return column;
}

}  // namespace

const std::vector<std::string>& remarks_of(const Cell& cell) {
  static const std::vector<std::string> none;
  if (const auto* estimate = std::get_if<Estimate>(&cell)) return estimate->remarks;
  if (const auto* missing = std::get_if<Missing>(&cell)) return missing->remarks;
  return none;
}

Layout::Layout(const Table& table) {
  const std::vector<ColumnKind> kinds = checked_kinds(table);
  for (const std::string& note : table.notes) notes.push_back({"", note});
  spans = spans_of(table.columns);
  for (const auto& cells : table.rows) {
    std::vector<LaidCell> row(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto* estimate = std::get_if<Estimate>(&cells[c]);
      if (estimate == nullptr) continue;
      row[c] = {numbers_of(*estimate), "", estimate->best};
      if (estimate->reached) {
        row[c].reached = fmt::format("({} of {})", *estimate->reached, estimate->n);
      }
    }
    rows.push_back(std::move(row));
  }
  mark_counts(table, *this);
  for (std::size_t c = 0; c < kinds.size(); ++c) columns.push_back(laid(table, *this, c, kinds[c]));
}

Extent Layout::extent_of(const Number& number, bool at_point) {
  if (!at_point) return {number.text().size(), 0};
  return {number.whole.size(), number.fraction.size() + number.exponent.size()};
}

std::string with_unit(const std::string& header, const std::string& unit) {
  if (unit.empty()) return header;
  return header + (header.empty() ? "(" : " (") + unit + ")";
}

std::string estimate_text(const LaidCell& cell, ColumnKind kind, std::string_view before,
                          std::string_view after) {
  std::string text = cell.numbers[0].text();
  if (cell.best) text = std::string(before) + text + std::string(after);
  if (cell.numbers.size() > 1) {
    const std::string first = cell.numbers[1].text();
    if (kind == ColumnKind::plus_minus) text += " ± " + first;
    if (kind == ColumnKind::deviation) text += " (" + first + ")";
    if (kind == ColumnKind::between) text += " [" + first + ", " + cell.numbers[2].text() + "]";
  }
  return text + (cell.reached.empty() ? "" : " " + cell.reached);
}

std::string superscript(const std::string& mark) {
  return mark.empty() ? "" : "<sup>" + mark + "</sup>";
}

std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

}  // namespace shoal::analysis
