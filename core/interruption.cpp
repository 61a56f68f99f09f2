#include "shoal/core/interruption.hpp"

#include <utility>

namespace shoal {
namespace {

thread_local const std::function<void()>* current = nullptr;

}  // namespace

Interruption::Interruption(std::function<void()> check)
    : check_(std::move(check)), outer_(std::exchange(current, &check_)) {}

Interruption::~Interruption() {
  current = outer_;
}

void check_interruption() {
  if (current) (*current)();
}

}  // namespace shoal
