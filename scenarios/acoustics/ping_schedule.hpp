#pragma once

#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// When vehicles ping within the period. Stateless: a function of the vehicle.
class PingSchedule {
 public:
  static constexpr const char* family = "ping_schedule";
  static constexpr const char* family_meaning = "when vehicles ping within the period";

  virtual ~PingSchedule() = default;

  /// How long after the first vehicle could (s), from 0 to below the period.
  virtual double delay_s(std::size_t vehicle, std::size_t vehicles, double period_s) const = 0;
};

}  // namespace shoal::scenarios
