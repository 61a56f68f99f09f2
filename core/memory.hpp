#pragma once

#include <memory>
#include <utility>

namespace shoal {

/// What a stateless interface remembers from one call to the next, for one caller: warm starts, a
/// latch. Every implementation has a type of its own.
class Memory {
 public:
  virtual ~Memory() = default;
  virtual std::unique_ptr<Memory> clone() const = 0;
};

/// A Memory of that content: `struct Latch { bool on = false; }; MemoryOf<Latch>`.
template <class Content>
struct MemoryOf final : Memory {
  Content content;

  std::unique_ptr<Memory> clone() const override { return std::make_unique<MemoryOf>(*this); }
};

/// Owns a Memory, or none; a copy owns a copy.
class OwnedMemory {
 public:
  OwnedMemory() = default;
  OwnedMemory(std::unique_ptr<Memory> memory) : memory_(std::move(memory)) {}  // NOLINT: as pointer
  OwnedMemory(const OwnedMemory& other)
      : memory_(other.memory_ ? other.memory_->clone() : nullptr) {}
  OwnedMemory(OwnedMemory&&) noexcept = default;
  OwnedMemory& operator=(OwnedMemory other) noexcept {
    memory_ = std::move(other.memory_);
    return *this;
  }
  ~OwnedMemory() = default;

  Memory* get() { return memory_.get(); }

 private:
  std::unique_ptr<Memory> memory_;
};

}  // namespace shoal
