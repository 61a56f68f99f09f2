#include "shoal/core/grid_index.hpp"

namespace shoal {

void GridIndex::build(std::span<const double> x, std::span<const double> y, double cell_m) {
  const std::size_t n = x.size();
  cell_m_ = cell_m;
  buckets_ = n > 0 ? n : 1;
  column_.resize(n);
  row_.resize(n);
  members_.resize(n);
  first_.assign(buckets_ + 1, 0);

  // Counting sort by bucket.
  for (std::size_t i = 0; i < n; ++i) {
    column_[i] = cell(x[i]);
    row_[i] = cell(y[i]);
    ++first_[bucket(column_[i], row_[i]) + 1];
  }
  for (std::size_t b = 0; b < buckets_; ++b) first_[b + 1] += first_[b];
  for (std::size_t i = n; i-- > 0;) {
    const std::size_t b = bucket(column_[i], row_[i]);
    members_[--first_[b + 1]] = static_cast<std::uint32_t>(i);
  }
  // Filling from the back left every start one bucket too far to the right.
  for (std::size_t b = 0; b < buckets_; ++b) first_[b] = first_[b + 1];
  first_[buckets_] = static_cast<std::uint32_t>(n);
}

}  // namespace shoal
