#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shoal/analysis/tables/latex_number.hpp"
#include "shoal/analysis/tables/latex_parts.hpp"
#include "shoal/analysis/tables/latex_signs.hpp"
#include "shoal/analysis/tables/latex_text.hpp"
#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::string raised(const std::string& mark) {
  return mark.empty() ? "" : "\\textsuperscript{" + mark + "}";
}

/// A column of siunitx: values aligned at the point, and behind each, as a text of the same width
/// in every row, its uncertainty and its mark.
class LatexColumn {
 public:
  LatexColumn(const Layout& layout, std::size_t c) : column_(layout.columns[c]) {
    for (const auto& row : layout.rows) {
      for (std::size_t k = 0; k < row[c].numbers.size(); ++k) rooms_[k].take(row[c].numbers[k]);
    }
    // Phantoms make all uncertainties as wide; powers of ten and marks come on top.
    std::pair<bool, std::size_t> most{false, 0};
    for (const auto& row : layout.rows) {
      std::size_t extra = row[c].mark.size() + row[c].reached.size();
      for (const Number& number : row[c].numbers) extra += number.exponent.size();
      const std::pair size{row[c].numbers.size() > 1, extra};
      if (widest_.empty() || size > most) widest_ = behind(row[c]);
      most = std::max(most, size);
    }
  }

  std::string specification() const {
    if (!column_.numeric()) return "l";
    const std::string post = widest_.empty() ? "" : ",table-space-text-post={" + widest_ + "}";
    return "S[table-format=" + rooms_[0].table_format() + post + "]";
  }

  std::string header(const Column& column) const {
    const std::string text = latex_with_unit(column.header, column.unit);
    return column_.numeric() ? "{" + text + "}" : text;
  }

  std::string cell(const Cell& cell, const LaidCell& laid) const {
    if (const auto* text = std::get_if<std::string>(&cell)) return latex_escaped(*text);
    if (laid.numbers.empty()) return "{--" + raised(laid.mark) + "}";
    if (laid.best) return best(laid);
    const std::string text = behind(laid);
    return latex_number(laid.numbers[0]) + (text.empty() ? "" : " {" + text + "}");
  }

 private:
  std::string behind(const LaidCell& laid) const {
    const std::string reached = laid.reached.empty() ? "" : "\\ " + laid.reached;
    if (laid.numbers.size() < 2) return reached + raised(laid.mark);
    const auto part = [&](std::size_t k, const std::string& open, const std::string& close) {
      const Number& number = laid.numbers[k];
      return rooms_[k].before(number) + open + number.whole + latex_from_point(number) + close +
             rooms_[k].after(number);
    };
    // Bold digits hang a little over their room.
    const std::string clear = column_.best ? "\\," : "";
    const std::string uncertainty =
        column_.kind == ColumnKind::plus_minus  ? "{}\\pm{}" + part(1, "", "")
        : column_.kind == ColumnKind::deviation ? "\\;" + part(1, "(", ")")
                                                : "\\;" + part(1, "[", ",") + part(2, "", "]");
    return "$" + clear + uncertainty + "$" + reached + raised(laid.mark);
  }

  /// Bold digits are wider than plain ones: they hang from the point to both sides, over a box just
  /// as wide as siunitx makes the other rows.
  std::string best(const LaidCell& laid) const {
    const Number& value = laid.numbers[0];
    const std::string right = rooms_[0].right();
    std::string text =
        "{$" + rooms_[0].left() + "$\\best{" + value.whole + "}{" + latex_from_point(value) + "}";
    if (!right.empty()) text += "$" + right + "$";
    if (!widest_.empty()) text += "\\rlap{" + behind(laid) + "}" + latex_phantom(widest_);
    return text + "}";
  }

  const LaidColumn& column_;
  std::array<LatexRoom, 3> rooms_;
  std::string widest_;  ///< text behind a number
};

std::string group_lines(const Layout& layout) {
  std::string titles, rules;
  std::size_t at = 0;
  for (const Span& span : layout.spans) {
    for (; at < span.first; ++at) titles += at == 0 ? "" : " &";
    titles += fmt::format("{}\\multicolumn{{{}}}{{c}}{{{}}}", at == 0 ? "" : " & ", span.count,
                          latex_with_unit(span.header, span.unit));
    at += span.count;
    rules += fmt::format("\\cmidrule(lr){{{}-{}}}", span.first + 1, at);
  }
  for (; at < layout.columns.size(); ++at) titles += " &";
  return "      " + titles + " \\\\\n      " + rules + "\n";
}

struct Body {
  std::vector<std::string> specifications;
  std::string head, rows;
};

Body body_of(const Table& table, const Layout& layout) {
  std::vector<LatexColumn> columns;
  for (std::size_t c = 0; c < layout.columns.size(); ++c) columns.emplace_back(layout, c);
  const auto line = [&](auto cell) {
    std::string joined = "      ";
    for (std::size_t c = 0; c < columns.size(); ++c) joined += (c == 0 ? "" : " & ") + cell(c);
    return joined + " \\\\\n";
  };
  Body body;
  for (const LatexColumn& column : columns) body.specifications.push_back(column.specification());
  body.head = "      \\toprule\n";
  if (!layout.spans.empty()) body.head += group_lines(layout);
  body.head += line([&](std::size_t c) { return columns[c].header(table.columns[c]); });
  if (!table.rows.empty()) body.head += "      \\midrule\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    body.rows +=
        line([&](std::size_t c) { return columns[c].cell(table.rows[r][c], layout.rows[r][c]); });
  }
  return body;
}

std::string tabular(const Table& table, const Layout& layout) {
  const Body body = body_of(table, layout);
  std::string printed = "    \\begin{tabular}{@{}\n";
  for (const std::string& specification : body.specifications) {
    printed += "      " + specification + "\n";
  }
  return printed + "      @{}}\n" + body.head + body.rows +
         "      \\bottomrule\n    \\end{tabular}";
}

constexpr std::size_t longest_line = 40;  // of a text that is not broken into lines

bool has_sentences(const Table& table) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (longest_text(table, c) > longest_line) return true;
  }
  return false;
}

/// Columns of sentences share what the others leave of the line, by the root of their lengths:
/// twice the text takes 1.4 times the width and 1.4 times the lines.
std::vector<std::string> with_paragraphs(std::vector<std::string> specifications,
                                         const Table& table, const Layout& layout) {
  constexpr double character = 0.012, gap = 0.02, least = 0.3;  // in widths of the line
  double left = 1.0, roots = 0.0;
  for (std::size_t c = 0; c < specifications.size(); ++c) {
    const std::size_t longest = longest_text(table, c);
    left -= gap;
    if (longest > longest_line) {
      roots += std::sqrt(static_cast<double>(longest));
      continue;
    }
    const Extent extent = layout.columns[c].extents[0];
    const std::size_t widest =
        std::max({longest, table.columns[c].header.size(), extent.before + extent.after});
    left -= character * static_cast<double>(widest);
  }
  left = std::max(left, least);
  for (std::size_t c = 0; c < specifications.size(); ++c) {
    const std::size_t longest = longest_text(table, c);
    if (longest <= longest_line) continue;
    specifications[c] = fmt::format(">{{\\raggedright\\arraybackslash}}p{{{:.3f}\\linewidth}}",
                                    left * std::sqrt(static_cast<double>(longest)) / roots);
  }
  return specifications;
}

/// Those about all, each on a line of its own; then those of marks, one after another.
std::string notes(const std::vector<Note>& notes) {
  if (notes.empty()) return "";
  std::string printed = "    \\par\\smallskip\\footnotesize\\raggedright\n";
  for (const Note& note : notes) {
    const std::string text = latex_escaped(note.text);
    printed += "    " +
               (note.mark.empty() ? text + "\\par"
                                  : "\\mbox{" + raised(note.mark) + "\\," + text + "}\\quad") +
               "\n";
  }
  return printed;
}

/// The box tells how wide the notes may be.
std::string box_of(const Table& table, const Layout& layout) {
  return "  \\sbox0{%\n" + tabular(table, layout) + "}%\n" +
         "  \\ifdim\\wd0>\\linewidth\\sbox0{\\resizebox{\\linewidth}{!}{\\usebox0}}\\fi\n"
         "  \\begin{minipage}{\\wd0}\n    \\usebox0\n" +
         notes(layout.notes) + "  \\end{minipage}\n";
}

/// A float, scaled down if it is a little wider than the lines of the paper, and parted if it is
/// much wider.
std::string boxed(const Table& table, const Layout& layout, const std::string& label) {
  std::string printed =
      "% \\usepackage{booktabs,graphicx,siunitx}\n\\begin{table}\n  \\centering\n"
      "  \\sisetup{group-digits=false}%\n";
  if (!table.caption.empty()) {
    printed += "  \\setlength{\\belowcaptionskip}{\\medskipamount}%\n  \\caption{" +
               latex_escaped(table.caption) + "}\n";
    if (!label.empty()) printed += "  " + label + "\n";
  }
  if (std::ranges::any_of(layout.columns, &LaidColumn::best)) {
    printed += "  \\def\\best#1#2{\\llap{\\boldmath$#1$}\\rlap{\\boldmath$#2$}}%\n";
  }
  const std::vector<LatexPart> parts = latex_parts(table, layout);
  for (const LatexPart& part : parts) {
    if (&part != &parts.front()) printed += "  \\par\\medskip\n";
    printed += box_of(part.table, part.layout);
  }
  return printed + "\\end{table}\n";
}

/// Sentences are broken into lines, and the table into pages.
std::string paragraphs(const Table& table, const Layout& layout, const std::string& label) {
  Body body = body_of(table, layout);
  body.specifications = with_paragraphs(std::move(body.specifications), table, layout);
  std::string printed =
      "% \\usepackage{booktabs,longtable,siunitx}\n"
      "% for pages of one column: longtable takes no others\n"
      "{\\footnotesize\\sisetup{group-digits=false}\\setlength{\\tabcolsep}{3pt}%\n"
      "  \\def\\best#1#2{\\llap{\\boldmath$#1$}\\rlap{\\boldmath$#2$}}%\n"
      "  \\begin{longtable}{@{}\n";
  for (const std::string& specification : body.specifications) {
    printed += "      " + specification + "\n";
  }
  printed += "      @{}}\n";
  if (!table.caption.empty()) {
    printed += "      \\caption{" + latex_escaped(table.caption) + "}" + label + "\\\\\n";
  }
  printed += body.head + "      \\endfirsthead\n" + body.head +
             "      \\endhead\n      \\bottomrule\n      \\endfoot\n" + body.rows +
             "  \\end{longtable}\n";
  if (!layout.notes.empty()) printed += notes(layout.notes) + "    \\par\n";
  return printed + "}\n";
}

}  // namespace

std::string as_latex(const Table& table) {
  const Layout layout(table);
  // Without a caption, a label would be that of the section.
  const bool labelled = !table.caption.empty() && !table.name.empty();
  const std::string label = labelled ? "\\label{tab:" + table.name + "}" : "";
  const std::string printed =
      has_sentences(table) ? paragraphs(table, layout, label) : boxed(table, layout, label);
  const std::vector<std::string> unknown = unknown_to_latex(printed);
  if (unknown.empty()) return printed;
  return "% Needs XeLaTeX or LuaLaTeX and a font that has " + listed(unknown) + "\n" + printed;
}

namespace {

struct InLatex final : TableFormat {
  std::string print(const Table& table) const override { return as_latex(table); }
  std::string file_ending() const override { return ".tex"; }

  static void declare(Options<InLatex>&) {}
};

const Register<TableFormat, InLatex> registered{"latex",
                                                "a table environment, with booktabs and siunitx"};

}  // namespace
}  // namespace shoal::analysis
