#pragma once

#include <functional>

namespace shoal {

/// While it lives, long work on this thread can be ended: check_interruption() calls `check`, and
/// what that throws ends the work.
class Interruption {
 public:
  explicit Interruption(std::function<void()> check);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

 private:
  std::function<void()> check_;
  const std::function<void()>* outer_;
};

/// To be called some ten times a second or more, where work may take seconds. Does nothing on a
/// thread without an Interruption.
void check_interruption();

}  // namespace shoal
