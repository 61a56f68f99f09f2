#include "shoal/analysis/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

using Row = std::vector<std::string>;

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string latex_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      escaped += fmt::format("\\{}{{}}", c);
    } else {
      if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

std::string markdown_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

template <class Cell>
std::string joined(const Row& row, std::string_view between, Cell cell) {
  std::string line;
  for (const std::string& text : row)
    line += (line.empty() ? "" : std::string(between)) + cell(text);
  return line;
}

/// Cells that stand for no number leave a column of numbers what it is.
bool numeric(const std::string& cell) {
  return cell.empty() || cell == "-" || parsed_number(cell).has_value();
}

}  // namespace

void TextTable::add(Row cells) {
  if (cells.size() != rows_.front().size()) {
    throw std::invalid_argument("a table's row has another number of cells than its header");
  }
  rows_.push_back(std::move(cells));
}

std::string TextTable::print(Format format) const {
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> width(columns, 0);
  std::vector<bool> right(columns, rows_.size() > 1);
  for (const Row& row : rows_) {
    for (std::size_t c = 0; c < columns; ++c) {
      width[c] = std::max(width[c], row[c].size());
      if (&row != &rows_.front() && !numeric(row[c])) right[c] = false;
    }
  }

  std::string printed;
  const auto head_then_rows = [&](auto line, const std::string& after_head) {
    printed += line(rows_.front()) + "\n" + after_head;
    for (std::size_t r = 1; r < rows_.size(); ++r) printed += line(rows_[r]) + "\n";
  };
  switch (format) {
    case Format::text:
      head_then_rows(
          [&](const Row& row) {
            std::string line;
            for (std::size_t c = 0; c < columns; ++c) {
              line += fmt::format(fmt::runtime(right[c] ? "{:>{}}" : "{:<{}}"), row[c], width[c]);
              line += "  ";
            }
            return line.substr(0, line.find_last_not_of(' ') + 1);
          },
          "");
      break;
    case Format::csv:
      head_then_rows([](const Row& row) { return joined(row, ",", csv_cell); }, "");
      break;
    case Format::markdown: {
      std::string rule = "|";
      for (std::size_t c = 0; c < columns; ++c) rule += right[c] ? "---:|" : "---|";
      head_then_rows([](const Row& row) { return "| " + joined(row, " | ", markdown_cell) + " |"; },
                     rule + "\n");
      break;
    }
    case Format::latex:
      printed += "\\begin{tabular}{";
      for (std::size_t c = 0; c < columns; ++c) printed += right[c] ? 'r' : 'l';
      printed += "}\n\\toprule\n";
      head_then_rows([](const Row& row) { return joined(row, " & ", latex_cell) + " \\\\"; },
                     "\\midrule\n");
      printed += "\\bottomrule\n\\end{tabular}\n";
      break;
  }
  return printed;
}

TextTable::Format table_format(std::string_view name) {
  using enum TextTable::Format;
  static const std::vector<std::string> names{"text", "csv", "markdown", "latex"};
  constexpr std::array formats{text, csv, markdown, latex};
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError("there is no format \"" + std::string(name) + '"' + suggestion(name, names));
  }
  return formats[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace shoal::analysis
