#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table_format.hpp"

namespace shoal::analysis {
namespace {

std::string escaped_html(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string html_cell(const Cell& cell, const LaidCell& laid, ColumnKind kind) {
  if (const auto* text = std::get_if<std::string>(&cell)) return escaped_html(*text);
  if (laid.numbers.empty()) return "–" + superscript(laid.mark);
  return estimate_text(laid, kind, "<strong>", "</strong>") + superscript(laid.mark);
}

std::string class_of(const LaidColumn& column) {
  return column.numeric() ? " class=\"number\"" : "";
}

/// Headers over several columns, where there are any.
std::string group_row(const Table& table, const Layout& layout) {
  if (layout.spans.empty()) return "";
  std::string row = "<tr>";
  std::size_t at = 0;
  for (const Span& span : layout.spans) {
    for (; at < span.first; ++at) row += "<td></td>";
    row += "<th scope=\"colgroup\" colspan=\"" + std::to_string(span.count) + "\">" +
           escaped_html(with_unit(span.header, span.unit)) + "</th>";
    at += span.count;
  }
  for (; at < table.columns.size(); ++at) row += "<td></td>";
  return row + "</tr>\n";
}

}  // namespace

std::string as_html(const Table& table) {
  const Layout layout(table);
  std::string printed = "<figure class=\"table\" id=\"tab:" + escaped_html(table.name) +
                        "\">\n<table>\n<caption>" + escaped_html(table.caption) +
                        "</caption>\n<thead>\n" + group_row(table, layout) + "<tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    printed += "<th scope=\"col\"" + class_of(layout.columns[c]) + ">" +
               escaped_html(with_unit(table.columns[c].header, table.columns[c].unit)) + "</th>";
  }
  printed += "</tr>\n</thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    printed += "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      printed += "<td" + class_of(layout.columns[c]) + ">" +
                 html_cell(table.rows[r][c], layout.rows[r][c], layout.columns[c].kind) + "</td>";
    }
    printed += "</tr>\n";
  }
  printed += "</tbody>\n</table>\n";
  if (!layout.notes.empty()) {
    printed += "<figcaption>";
    for (const Note& note : layout.notes) {
      printed += "<p>" + superscript(note.mark) + escaped_html(note.text) + "</p>";
    }
    printed += "</figcaption>\n";
  }
  return printed + "</figure>\n";
}

namespace {

struct InHtml final : TableFormat {
  std::string print(const Table& table) const override { return as_html(table); }

  static void declare(Options<InHtml>&) {}
};

const Register<TableFormat, InHtml> registered{"html",
                                               "a table element, in a figure with its notes"};

}  // namespace
}  // namespace shoal::analysis
