#pragma once

#include <cstdlib>
#include <string>

#include "shoal/core/csv_table.hpp"

namespace shoal::tests {

/// A table of tests/data with the columns that a test reads; its numbers may be nan.
class ReferenceTable {
 public:
  ReferenceTable(const std::string& name, std::vector<std::string> columns)
      : table_({SHOAL_SOURCE_DIR "/tests/data/" + name, {}},
               {.required = std::move(columns), .pass_over_others = true}) {}

  std::size_t rows() const { return table_.rows(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    return table_.text(row, column);
  }
  double number(std::size_t row, const std::string& column) const {
    return std::strtod(text(row, column).c_str(), nullptr);
  }
  /// For messages.
  std::string line(std::size_t row) const { return table_.origin(row).prefix(); }

 private:
  CsvTable table_;
};

}  // namespace shoal::tests
