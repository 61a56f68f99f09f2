#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shoal::analysis {

/// A table of texts that can be printed in several ways. The first row holds the headers; columns
/// whose cells are all numbers are aligned to the right.
class TextTable {
 public:
  enum class Format { text, csv, markdown, latex };

  explicit TextTable(std::vector<std::string> headers) : rows_{std::move(headers)} {}

  /// Throws std::invalid_argument unless there is a cell for every column.
  void add(std::vector<std::string> cells);

  /// Ends with a line break. LaTeX is a tabular in the style of booktabs, with special characters
  /// escaped.
  std::string print(Format format) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Throws InputError, naming the known ones, for anything but text, csv, markdown and latex.
TextTable::Format table_format(std::string_view name);

}  // namespace shoal::analysis
