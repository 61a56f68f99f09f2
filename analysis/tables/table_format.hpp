#pragma once

#include <memory>
#include <string>

#include "shoal/analysis/tables/table.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// A form that tables are written in.
class TableFormat {
 public:
  static constexpr const char* family = "table_format";
  static constexpr const char* family_meaning = "a form that tables are written in";

  virtual ~TableFormat() = default;
  virtual std::string print(const Table& table) const = 0;

  /// How the files end in which the tables of a study are written so; "" for none.
  virtual std::string file_ending() const { return ""; }
};

/// Throws InputError, naming the known ones, if there is none of that name.
std::unique_ptr<TableFormat> table_format(const std::string& name);

}  // namespace shoal::analysis
