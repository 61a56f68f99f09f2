#include "shoal/analysis/benchmarking/large_blocks.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace shoal::analysis {
namespace {

constexpr std::size_t page_bytes = std::size_t{2} << 20;
constexpr std::size_t page_doubles = page_bytes / sizeof(double);
constexpr std::size_t block_doubles = 4096;

double* new_pages(std::size_t doubles) {
  const std::size_t bytes = (doubles * sizeof(double) + page_bytes - 1) / page_bytes * page_bytes;
  void* memory = ::operator new(bytes, std::align_val_t(page_bytes));
#ifdef MADV_HUGEPAGE
  ::madvise(memory, bytes, MADV_HUGEPAGE);  // advice: where it is not taken, nothing is lost
#endif
  return static_cast<double*>(memory);
}

}  // namespace

void LargeBlocks::Free::operator()(double* memory) const noexcept {
  ::operator delete(memory, std::align_val_t(page_bytes));
}

double* LargeBlocks::take(std::size_t doubles, std::size_t& size) {
  size = std::max(doubles, block_doubles);
  const std::lock_guard lock(mutex_);
  if (size > page_doubles) return pages_.emplace_back(new_pages(size)).get();
  if (left_ < size) {
    next_ = pages_.emplace_back(new_pages(page_doubles)).get();
    left_ = page_doubles;
  }
  double* const block = next_;
  next_ += size;
  left_ -= size;
  return block;
}

}  // namespace shoal::analysis
