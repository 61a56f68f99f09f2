#include "shoal/solvers/matching/slot_field.hpp"

#include <cmath>
#include <limits>

namespace shoal::solvers {
namespace {

constexpr double most_cells = 65536;
constexpr double most_work = 1 << 26;  // cells x slots: a fraction of a second
constexpr double margin = 0.25;        // of the longer side, all round

}  // namespace

SlotField::SlotField(std::span<const Eigen::Vector2d> slots) {
  Eigen::Array2d low = slots[0], high = slots[0];
  Eigen::ArrayXf x(static_cast<Eigen::Index>(slots.size())), y(x.size());
  for (const Eigen::Vector2d& slot : slots) {
    low = low.min(slot.array());
    high = high.max(slot.array());
  }
  const double longer = std::max((high - low).maxCoeff(), 1.0);
  low -= margin * longer;
  high += margin * longer;
  const Eigen::Array2d size = high - low;
  const double cells =
      std::clamp(most_work / static_cast<double>(slots.size()), 1024.0, most_cells);
  const double cell_m = std::sqrt(size.prod() / cells);
  columns_ = static_cast<std::size_t>(std::ceil(size.x() / cell_m)) + 1;
  rows_ = static_cast<std::size_t>(std::ceil(size.y() / cell_m)) + 1;
  left_ = low.x();
  bottom_ = low.y();
  per_cell_ = 1.0 / cell_m;

  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::Vector2d& slot = slots[static_cast<std::size_t>(j)];
    x[j] = static_cast<float>(slot.x() - left_);
    y[j] = static_cast<float>(slot.y() - bottom_);
  }
  // From the middle of a cell to its corner, and what floats round.
  const double rounding = 16.0 * std::numeric_limits<float>::epsilon() * size.maxCoeff();
  const double less = std::sqrt(0.5) * cell_m + rounding;
  distance_.reserve(rows_ * columns_);
  for (std::size_t row = 0; row < rows_; ++row) {
    const auto v = static_cast<float>((static_cast<double>(row) + 0.5) * cell_m);
    for (std::size_t column = 0; column < columns_; ++column) {
      const auto u = static_cast<float>((static_cast<double>(column) + 0.5) * cell_m);
      const float nearest = std::sqrt(((x - u).square() + (y - v).square()).minCoeff());
      distance_.push_back(std::max(nearest - static_cast<float>(less), 0.0f));
    }
  }
}

}  // namespace shoal::solvers
