#include "shoal/analysis/tables/table.hpp"

#include <algorithm>
#include <array>

#include "shoal/analysis/tables/layout.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {

std::string print(const Table& table, TableFormat format) {
  constexpr std::array writers{as_text, as_csv, as_markdown, as_latex, as_html};
  return writers.at(static_cast<std::size_t>(format))(table);
}

TableFormat table_format(std::string_view name) {
  using enum TableFormat;
  static const std::vector<std::string> names{"text", "csv", "markdown", "latex", "html"};
  constexpr std::array formats{text, csv, markdown, latex, html};
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError("there is no format \"" + std::string(name) + '"' + suggestion(name, names));
  }
  return formats[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace shoal::analysis
