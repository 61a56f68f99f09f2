#pragma once

#include <span>
#include <string>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal {

/// What a CSV file must and may have; other columns are errors, or passed over.
struct CsvColumns {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  bool pass_over_others = false;
};

/// A small CSV file, its columns known by name and its rows by their line.
///
/// The first line names the columns, in any order. Blank lines and lines that start with # are
/// passed over, except for what may be a row whose first field starts with it (`#1,0,0`): that is
/// refused. CRLF, a UTF-8 byte order mark and "quoted" fields are understood; text is UTF-8. Every
/// complaint is an InputError that begins with `file:line: `.
class CsvTable {
 public:
  /// Throws InputError if the file cannot be opened (pointing at where it was named), has no
  /// header or no rows, lacks a required column, has an unknown or repeated one, or has a row with
  /// another number of fields.
  CsvTable(const FilePath& file, const CsvColumns& columns);

  std::size_t rows() const { return lines_.size(); }
  bool has(const std::string& column) const;

  /// The field as written. Throws InputError if it is empty.
  const std::string& text(std::size_t row, const std::string& column) const;

  /// Throws InputError unless the field is a finite number.
  double number(std::size_t row, const std::string& column) const;

  /// The whole column, as text() and number() give it.
  std::vector<std::string> texts(const std::string& column) const;
  std::vector<double> numbers(const std::string& column) const;

  Origin origin(std::size_t row) const { return {file_, lines_[row]}; }

 private:
  bool is_comment(std::string_view line, const Origin& here) const;
  void take_header(const std::vector<std::string>& fields, int line, const CsvColumns& columns);
  std::size_t column_index(const std::string& column) const;

  std::string file_;
  std::vector<std::string> header_;
  std::vector<int> lines_;           // of each row
  std::vector<std::string> fields_;  // row by row
};

}  // namespace shoal
