#include <algorithm>

#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table_format.hpp"

namespace shoal::analysis {
namespace {

constexpr std::size_t gap = 2;  // blanks between columns

std::string blanks(std::size_t count) {
  return std::string(count, ' ');
}

/// In characters of UTF-8, all of which are taken to be as wide.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string trimmed_end(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

struct Padding {
  std::string before, after;
};

Padding padding_of(const Number& number, const LaidColumn& column, std::size_t k) {
  const Extent own = Layout::extent_of(number, column.at_point);
  const Extent all = column.extents[k];
  return {blanks(all.before - own.before), blanks(all.after - own.after)};
}

/// The number and its uncertainty. Brackets stand close to their numbers, blanks outside.
std::string aligned(const std::vector<Number>& numbers, const LaidColumn& column) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Padding pad = padding_of(numbers[k], column, k);
    const std::string number = numbers[k].text();
    if (k == 0) {
      text += pad.before + number + pad.after;
    } else if (column.kind == ColumnKind::plus_minus) {
      text += " +- " + pad.before + number + pad.after;
    } else if (column.kind == ColumnKind::deviation) {
      text += " " + pad.before + "(" + number + ")" + pad.after;
    } else if (k == 1) {
      text += " " + pad.before + "[" + number + "," + pad.after;
    } else {
      text += " " + pad.before + number + "]" + pad.after;
    }
  }
  return text;
}

/// A column as texts, all cells of the same width.
std::vector<std::string> cells_of(const Table& table, const Layout& layout, std::size_t c) {
  const LaidColumn& column = layout.columns[c];
  std::vector<std::string> bodies, tails;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const LaidCell& laid = layout.rows[r][c];
    const auto* text = std::get_if<std::string>(&table.rows[r][c]);
    bodies.push_back(text != nullptr ? on_one_line(*text)
                     : laid.numbers.empty() && column.numeric()
                         ? blanks(column.extents[0].before - 1) + "-"
                     : laid.numbers.empty() ? "-"
                                            : aligned(laid.numbers, column) +
                                                  (laid.reached.empty() ? "" : " " + laid.reached));
    tails.push_back((laid.best ? "*" : "") + (laid.mark.empty() ? "" : "^" + laid.mark));
  }
  const auto widest = [](const std::vector<std::string>& texts) {
    std::size_t most = 0;
    for (const std::string& text : texts) most = std::max(most, width(text));
    return most;
  };
  const std::size_t body = widest(bodies), tail = widest(tails);
  for (std::size_t r = 0; r < bodies.size(); ++r) {
    bodies[r] += blanks(body - width(bodies[r])) + tails[r] + blanks(tail - width(tails[r]));
  }
  return bodies;
}

/// `--- ping period (s) ---`, over all of its columns.
std::string group_line(const std::vector<Span>& spans, const std::vector<std::size_t>& widths,
                       const std::vector<std::string>& titles) {
  std::string line;
  std::size_t c = 0, at = 0;
  for (std::size_t s = 0; s < spans.size(); ++s) {
    std::size_t room = 0;
    for (; c < spans[s].first; ++c) at += widths[c] + gap;
    line += blanks(at - width(line));
    for (; c < spans[s].first + spans[s].count; ++c) room += widths[c] + gap;
    const std::size_t dashes = room - gap - width(titles[s]) - 2;
    line += std::string(dashes / 2, '-') + " " + titles[s] + " " +
            std::string(dashes - dashes / 2, '-');
    at += room;
  }
  return trimmed_end(line);
}

}  // namespace

std::string as_text(const Table& table) {
  const Layout layout(table);
  const std::size_t columns = table.columns.size();
  std::vector<std::string> headers, titles;
  std::vector<std::vector<std::string>> cells;
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns; ++c) {
    headers.push_back(on_one_line(with_unit(table.columns[c].header, table.columns[c].unit)));
    cells.push_back(cells_of(table, layout, c));
    widths.push_back(width(headers[c]));
    if (!cells[c].empty()) widths[c] = std::max(widths[c], width(cells[c].front()));
  }
  for (const Span& span : layout.spans) {
    titles.push_back(on_one_line(with_unit(span.header, span.unit)));
    std::size_t room = (span.count - 1) * gap;
    for (std::size_t c = span.first; c < span.first + span.count; ++c) room += widths[c];
    const std::size_t wanted = width(titles.back()) + 4;
    if (room < wanted) widths[span.first + span.count - 1] += wanted - room;
  }

  std::string printed;
  if (!table.caption.empty()) printed += on_one_line(table.caption) + "\n\n";
  if (!layout.spans.empty()) printed += group_line(layout.spans, widths, titles);
  const auto add_line = [&](auto text_of) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string pad = blanks(widths[c] - width(text_of(c)));
      line += (layout.columns[c].numeric() ? pad + text_of(c) : text_of(c) + pad) + blanks(gap);
    }
    printed += trimmed_end(line);
  };
  add_line([&](std::size_t c) { return headers[c]; });
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    add_line([&](std::size_t c) { return cells[c][r]; });
  }

  const bool best = std::ranges::any_of(layout.columns, &LaidColumn::best);
  if (best || !layout.notes.empty()) printed += "\n";
  if (best) printed += "* best.\n";
  for (const Note& note : layout.notes) {
    printed += (note.mark.empty() ? "" : "^" + note.mark + " ") + on_one_line(note.text) + "\n";
  }
  return printed;
}

namespace {

struct InText final : TableFormat {
  std::string print(const Table& table) const override { return as_text(table); }

  static void declare(Options<InText>&) {}
};

const Register<TableFormat, InText> registered{"text", "for terminals"};

}  // namespace
}  // namespace shoal::analysis
