#include <cctype>

#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table_format.hpp"

namespace shoal::analysis {
namespace {

bool alphanumeric(const std::string& text, std::size_t i) {
  return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
}

/// What GitHub would take for markup. An underscore within a word is none (GitHub Flavored
/// Markdown, sec. 6.2).
std::string escaped_markdown(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool within_word = i > 0 && alphanumeric(text, i - 1) && alphanumeric(text, i + 1);
    const bool special = std::string_view("\\`*<[|~$").find(text[i]) != std::string_view::npos ||
                         (text[i] == '_' && !within_word);
    if (special) out += '\\';
    out += text[i];
  }
  return on_one_line(out);
}

std::string markdown_cell(const Cell& cell, const LaidCell& laid, ColumnKind kind) {
  if (const auto* text = std::get_if<std::string>(&cell)) return escaped_markdown(*text);
  if (laid.numbers.empty()) return "–" + superscript(laid.mark);
  return estimate_text(laid, kind, "**", "**") + superscript(laid.mark);
}

/// Pipe tables have one line of headers: the group's comes first.
std::string header_text(const Column& column) {
  const std::string own = escaped_markdown(with_unit(column.header, column.unit));
  if (column.group.empty()) return own;
  return escaped_markdown(with_unit(column.group, column.group_unit)) + ": " + own;
}

}  // namespace

std::string as_markdown(const Table& table) {
  const Layout layout(table);
  std::string printed, rule = "|";
  if (!table.caption.empty()) printed += escaped_markdown(table.caption) + "\n\n";
  printed += "|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    printed += " " + header_text(table.columns[c]) + " |";
    rule += layout.columns[c].numeric() ? "---:|" : "---|";
  }
  printed += "\n" + rule + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    printed += "|";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      printed +=
          " " + markdown_cell(table.rows[r][c], layout.rows[r][c], layout.columns[c].kind) + " |";
    }
    printed += "\n";
  }
  bool marks = false;  // notes of marks go on in one paragraph
  for (const Note& note : layout.notes) {
    if (!marks) printed += "\n";
    marks = !note.mark.empty();
    printed += superscript(note.mark) + (marks ? " " : "") + escaped_markdown(note.text) + "\n";
  }
  return printed;
}

namespace {

struct InMarkdown final : TableFormat {
  std::string print(const Table& table) const override { return as_markdown(table); }
  std::string file_ending() const override { return ".md"; }

  static void declare(Options<InMarkdown>&) {}
};

const Register<TableFormat, InMarkdown> registered{"markdown", "a pipe table of GitHub"};

}  // namespace
}  // namespace shoal::analysis
