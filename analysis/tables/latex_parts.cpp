#include "shoal/analysis/tables/latex_parts.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace shoal::analysis {
namespace {

using Columns = std::vector<std::size_t>;

constexpr double most_pt = 345.0 / 0.7;  // a line of an article's, and type of seven points

/// About how wide a column is set (pt), of ten-point type.
double width_of(const Table& table, const Layout& layout, std::size_t column) {
  constexpr double character = 5.0, separation = 12.0, signs = 8.0;
  const LaidColumn& laid = layout.columns[column];
  double numbers = 0.0;
  for (const Extent& extent : laid.extents) {
    const auto characters = static_cast<double>(extent.before + extent.after);
    numbers += characters * character + (numbers > 0.0 && characters > 0.0 ? signs : 0.0);
  }
  if (laid.reached) numbers += 10.0 * character;
  const std::size_t text =
      std::max(longest_text(table, column),
               with_unit(table.columns[column].header, table.columns[column].unit).size());
  return std::max(numbers, character * static_cast<double>(text)) + separation;
}

double width_of(const Table& table, const Layout& layout, const Columns& columns) {
  return std::accumulate(columns.begin(), columns.end(), 0.0, [&](double sum, std::size_t c) {
    return sum + width_of(table, layout, c);
  });
}

/// Columns without a header above them, where others have one; else texts, and always the first.
std::size_t count_labels(const Layout& layout) {
  if (!layout.spans.empty()) return layout.spans.front().first;
  const auto numeric = std::ranges::find_if(layout.columns, &LaidColumn::numeric);
  return std::max<std::size_t>(1, static_cast<std::size_t>(numeric - layout.columns.begin()));
}

/// The columns from `first` on, those under one header together.
std::vector<Columns> groups_of(const Layout& layout, std::size_t first) {
  std::vector<Columns> groups;
  for (std::size_t c = first; c < layout.columns.size(); ++c) {
    const bool inside = std::ranges::any_of(layout.spans, [&](const Span& span) {
      return c > span.first && c < span.first + span.count;
    });
    if (!inside) groups.emplace_back();
    groups.back().push_back(c);
  }
  return groups;
}

LatexPart part_of(const Table& table, const Layout& layout, const Columns& columns) {
  Table part;
  for (const std::size_t c : columns) part.columns.push_back(table.columns[c]);
  for (const auto& row : table.rows) {
    part.rows.emplace_back();
    for (const std::size_t c : columns) part.rows.back().push_back(row[c]);
  }
  Layout laid(part);
  laid.notes.clear();
  for (std::size_t r = 0; r < laid.rows.size(); ++r) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      laid.rows[r][k] = layout.rows[r][columns[k]];
    }
  }
  return {std::move(part), std::move(laid)};
}

}  // namespace

std::size_t longest_text(const Table& table, std::size_t column) {
  std::size_t longest = 0;
  for (const auto& row : table.rows) {
    const auto* text = std::get_if<std::string>(&row[column]);
    if (text) longest = std::max(longest, text->size());
  }
  return longest;
}

std::vector<LatexPart> latex_parts(const Table& table, const Layout& layout) {
  Columns all(layout.columns.size());
  std::iota(all.begin(), all.end(), 0);
  if (width_of(table, layout, all) <= most_pt) return {{table, layout}};
  const std::size_t first = std::min(count_labels(layout), all.size());
  const Columns labels(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first));
  const double room = most_pt - width_of(table, layout, labels);

  std::vector<Columns> parts;
  double left = 0.0;
  const auto append = [&](const Columns& columns) {
    const double width = width_of(table, layout, columns);
    if (parts.empty() || width > left) {
      parts.push_back(labels);
      left = room;
    }
    left -= width;
    parts.back().insert(parts.back().end(), columns.begin(), columns.end());
  };
  for (const Columns& group : groups_of(layout, first)) {
    if (width_of(table, layout, group) <= room) {
      append(group);
    } else {
      for (const std::size_t c : group) append({c});
    }
  }
  if (parts.size() < 2) return {{table, layout}};
  std::vector<LatexPart> parted;
  for (const Columns& columns : parts) parted.push_back(part_of(table, layout, columns));
  parted.back().layout.notes = layout.notes;
  return parted;
}

}  // namespace shoal::analysis
