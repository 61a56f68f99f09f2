#pragma once

#include "shoal/analysis/tables/layout.hpp"

namespace shoal::analysis {

/// What each column holds. Throws std::invalid_argument as print() says.
std::vector<ColumnKind> checked_kinds(const Table& table);

}  // namespace shoal::analysis
