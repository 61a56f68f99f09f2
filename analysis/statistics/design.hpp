#pragma once

#include <Eigen/Core>
#include <span>

#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// A matrix of that many cells still fits into memory; more trials than that are a mistake.
inline constexpr double most_cells = 1e7;

/// How the cells of a study are chosen from its factors.
class Design {
 public:
  static constexpr const char* family = "design";
  static constexpr const char* family_meaning = "chooses the cells of a study from its factors";

  virtual ~Design() = default;

  /// Whether its cells are samples of the ranges, which are told apart by a number, and not the
  /// combinations of given levels.
  virtual bool draws() const { return true; }

  /// Cells x factors: where each factor stands in its range, from 0 to 1. `levels[f]` is the number
  /// of levels of factor f, or 0 if it is continuous; with n levels it takes level
  /// min(floor(u n), n - 1). Throws InputError if the design cannot take these factors.
  virtual Eigen::MatrixXd cells(std::span<const int> levels) const = 0;
};

}  // namespace shoal::analysis
