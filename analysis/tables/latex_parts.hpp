#pragma once

#include <cstddef>
#include <vector>

#include "shoal/analysis/tables/layout.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// Characters of the longest text of a column: 0 of numbers.
std::size_t longest_text(const Table& table, std::size_t column);

struct LatexPart {
  Table table;
  Layout layout;  ///< with the marks of the whole table
};

/// The table, or its columns parted into tables that stand below one another, where all in one row
/// would be set too small. What a row is called begins each of them; columns under one header stay
/// together if they can. The notes of all stand below the last.
std::vector<LatexPart> latex_parts(const Table& table, const Layout& layout);

}  // namespace shoal::analysis
