#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

/// The cells of a group as an array: a dimension for each factor of a grid, or `cell` alone for a
/// design that draws its cells.
class GroupGrid {
 public:
  struct Dimension {
    std::string name;
    std::vector<std::string> labels;
  };

  explicit GroupGrid(const TrialGroup& group);

  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  /// How many places the array has; a grid may have places that are no cell.
  std::size_t size() const;
  /// Where a cell stands in each dimension, and in all places counted with the last one fastest.
  std::vector<std::size_t> indices(std::size_t cell) const;
  std::size_t offset(std::size_t cell) const;

 private:
  const TrialGroup& group_;
  std::vector<Dimension> dimensions_;
};

}  // namespace shoal::analysis
