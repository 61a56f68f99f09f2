#include "shoal/analysis/experiments/study/group_grid.hpp"

#include <algorithm>

namespace shoal::analysis {

GroupGrid::GroupGrid(const TrialGroup& group) : group_(group) {
  if (group.sampled()) {
    dimensions_.push_back({"cell", {}});
    Dimension& cells = dimensions_.back();
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      cells.labels.push_back(group.labels(cell).front());
    }
    return;
  }
  for (std::size_t f = 0; f < group.axes().size(); ++f) {
    const Axis& axis = group.axes()[f];
    dimensions_.push_back({axis.name(), {}});
    Dimension& levels = dimensions_.back();
    for (std::size_t i = 0; i < static_cast<std::size_t>(axis.levels()); ++i) {
      levels.labels.push_back(axis.level(i).label);
    }
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      if (group.labels(cell)[f] != not_applied) continue;
      levels.labels.emplace_back(not_applied);
      break;
    }
  }
}

std::size_t GroupGrid::size() const {
  std::size_t size = 1;
  for (const Dimension& dimension : dimensions_) size *= dimension.labels.size();
  return size;
}

std::vector<std::size_t> GroupGrid::indices(std::size_t cell) const {
  if (group_.sampled()) return {cell};
  std::vector<std::size_t> indices;
  for (std::size_t f = 0; f < dimensions_.size(); ++f) {
    const auto& labels = dimensions_[f].labels;
    const auto found = std::ranges::find(labels, group_.labels(cell)[f]);
    indices.push_back(static_cast<std::size_t>(found - labels.begin()));
  }
  return indices;
}

std::size_t GroupGrid::offset(std::size_t cell) const {
  std::size_t offset = 0;
  const std::vector<std::size_t> place = indices(cell);
  for (std::size_t f = 0; f < place.size(); ++f) {
    offset = offset * dimensions_[f].labels.size() + place[f];
  }
  return offset;
}

}  // namespace shoal::analysis
