#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace shoal::analysis {

/// Memory for what is noted while a trial runs, in blocks that any thread may take. They come from
/// pages of 2 MB where the system has such: a first touch of a small page costs as much as writing
/// it several times. What was taken is freed with this.
class LargeBlocks {
 public:
  /// Not initialised. At least `doubles` of them; `size` is set to how many there are.
  double* take(std::size_t doubles, std::size_t& size);

 private:
  struct Free {
    void operator()(double* memory) const noexcept;
  };

  std::mutex mutex_;
  std::vector<std::unique_ptr<double, Free>> pages_;
  double* next_ = nullptr;
  std::size_t left_ = 0;
};

}  // namespace shoal::analysis
