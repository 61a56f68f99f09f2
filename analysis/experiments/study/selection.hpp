#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shoal/core/setting.hpp"

namespace shoal::analysis {

/// Some cells of a study: those whose factors have one of the labels named.
///
/// Written as a table, `{ behaviour = "rigid_registration", period_s = [5, 15] }`.
class CellSelection {
 public:
  CellSelection() = default;
  /// Throws InputError unless the setting is such a table.
  explicit CellSelection(const Setting& table);

  bool empty() const { return wanted_.empty(); }
  std::vector<std::string> factors() const;
  /// Whether it leaves one label of a factor.
  bool names_one(const std::string& factor) const;
  const std::vector<std::pair<std::string, std::vector<std::string>>>& wanted() const {
    return wanted_;
  }
  const Origin& origin() const { return origin_; }

  /// Whether a cell belongs to it. `labels` has one label for each name; a factor that the
  /// selection names and the cell does not have excludes the cell.
  bool holds(std::span<const std::string> names, std::span<const std::string> labels) const;

  /// `behaviour = rigid_registration, period_s = 5 or 15`.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> wanted_;
  Origin origin_;
};

/// A table, or a list of them. `name` is what it is written as, for the message of InputError.
std::vector<CellSelection> cell_selections(const Setting& setting, const std::string& name);

/// Names of the factors of all these.
std::vector<std::string> factors_of(const CellSelection& one,
                                    const std::vector<CellSelection>& others);

}  // namespace shoal::analysis
