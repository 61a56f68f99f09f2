#include "shoal/analysis/tables/latex_text.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "shoal/analysis/tables/latex_signs.hpp"
#include "shoal/analysis/tables/layout.hpp"

namespace shoal::analysis {

std::string latex_escaped(const std::string& text) {
  // In the default encoding < > and | print as other signs.
  static const std::vector<std::pair<std::string_view, std::string_view>> spelt{
      {"\\", "\\textbackslash{}"},
      {"~", "\\textasciitilde{}"},
      {"^", "\\textasciicircum{}"},
      {"<", "\\textless{}"},
      {">", "\\textgreater{}"},
      {"|", "\\textbar{}"},
      {"\"", "''"},
      {"[", "{[}"},  // as \\* and \\[, both would be taken for options of the row before
      {"*", "{*}"},
      {"&", "\\&"},
      {"%", "\\%"},
      {"$", "\\$"},
      {"#", "\\#"},
      {"_", "\\_"},
      {"{", "\\{"},
      {"}", "\\}"}};
  const std::string line = on_one_line(text);
  std::string escaped;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = at + 1;
    while (end < line.size() && (static_cast<unsigned char>(line[end]) & 0xc0u) == 0x80u) ++end;
    if (const auto sign = latex_sign(std::string_view(line).substr(at, end - at))) {
      escaped += *sign;
      at = end;
      continue;
    }
    const auto found =
        std::ranges::find_if(spelt, [rest = std::string_view(line).substr(at)](const auto& pair) {
          return rest.starts_with(pair.first);
        });
    escaped += found == spelt.end() ? std::string_view(line).substr(at, 1) : found->second;
    at += found == spelt.end() ? 1 : found->first.size();
    // Two of these would be taken for one sign.
    const bool ligature = std::string_view("-`'").find(line[at - 1]) != std::string_view::npos;
    if (ligature && line[at - 1] == line[at]) escaped += "{}";
  }
  return escaped;
}

std::string latex_with_unit(const std::string& header, const std::string& unit) {
  // \si is version 2's \unit, which version 3 understands.
  static const std::map<std::string, std::string> spelt{
      {"%", "\\percent"}, {"deg", "\\degree"}, {"us", "\\micro\\second"}};
  const auto found = spelt.find(unit);
  const bool literal = unit.find_first_of("\\~&%$#_{}<>|\"`") == std::string::npos;
  const std::string printed = found != spelt.end() ? "\\si{" + found->second + "}"
                              : literal            ? "\\si{" + unit + "}"
                                                   : latex_escaped(unit);
  return unit.empty() ? latex_escaped(header)
                      : latex_escaped(header) + (header.empty() ? "(" : " (") + printed + ")";
}

}  // namespace shoal::analysis
