#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace shoal {

/// A vector that allocates only for more than `few` elements: those of a control loop are few.
template <class T, std::size_t few>
class SmallVector {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  SmallVector() = default;
  /// The elements are not initialised unless they are many.
  explicit SmallVector(std::size_t size) : size_(size) {
    if (size > few) many_.resize(size);
  }

  void push_back(const T& element) {
    if (size_ < few) {
      few_[size_] = element;
    } else {
      if (size_ == few) many_.assign(few_.begin(), few_.end());
      many_.push_back(element);
    }
    ++size_;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return size_ > few ? many_.data() : few_.data(); }
  const T* data() const { return size_ > few ? many_.data() : few_.data(); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  std::array<T, few> few_;  // as long as there are no more
  std::vector<T> many_;     // else all of them
  std::size_t size_ = 0;
};

}  // namespace shoal
