#pragma once

#include <cstddef>
#include <vector>

#include "shoal/analysis/benchmarking/corpus.hpp"
#include "shoal/analysis/benchmarking/large_blocks.hpp"

namespace shoal::analysis {

/// Situations of one vehicle, each a row of doubles: half as long as a Situation, and written
/// without a call of the allocator.
class PackedSituations {
 public:
  /// The blocks may be shared, and outlive this.
  explicit PackedSituations(LargeBlocks& blocks) : blocks_(&blocks) {}

  void add(const formations::Neighbourhood& seen);

  /// Leaves the first, third, fifth ...; the room of the others is used again.
  void keep_every_second();

  std::size_t size() const { return size_; }
  Situation operator[](std::size_t k) const;

 private:
  struct Room {
    double* begin = nullptr;
    std::size_t capacity = 0;
  };

  Room new_room(std::size_t doubles);

  LargeBlocks* blocks_;
  std::vector<Room> rooms_;  // beyond size_: to be used again
  std::size_t size_ = 0;
  Room left_;  // of the last block
};

}  // namespace shoal::analysis
