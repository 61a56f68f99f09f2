#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shoal/core/random.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// What goes wrong on purpose: vehicles that fall silent for good. Stateless.
class Fault {
 public:
  static constexpr const char* family = "fault";
  static constexpr const char* family_meaning = "what goes wrong on purpose";

  virtual ~Fault() = default;

  /// At how many instants vehicles are lost.
  virtual std::int64_t count() const = 0;
  /// The first of them, and the time from each to the next (s); a multiple of the tick.
  virtual double every_s() const = 0;

  /// Appends those vehicles that are lost at such an instant, of those that are left (in rising
  /// order); `gone` vehicles were lost before. Draws from Purpose::node_loss, or from a purpose of
  /// its own.
  virtual void lose(std::span<const std::size_t> left, std::size_t gone,
                    const RandomStreams& random, std::vector<std::size_t>& lost) const = 0;
};

}  // namespace shoal::scenarios
