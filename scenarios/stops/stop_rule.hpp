#pragma once

#include <optional>
#include <span>
#include <string>

#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// The formation quality (m) as it was measured until now, at rising times (s).
struct QualitySoFar {
  std::span<const double> time_s, quality_m;
};

/// When a trial ends before trial.duration_s. Stateless: a function of what was measured.
class StopRule {
 public:
  static constexpr const char* family = "stop";
  static constexpr const char* family_meaning = "when a trial ends before its duration";

  virtual ~StopRule() = default;

  /// Whether it may end a trial at all.
  virtual bool watches() const { return true; }
  /// Whether it goes by the formation quality, which an observer of the world must measure.
  virtual bool needs_quality() const = 0;
  /// Why it cannot go by a quality that is measured every so many seconds, or nothing if it can.
  virtual std::optional<std::string> refuses_quality_every(double every_s) const = 0;

  virtual bool met(const QualitySoFar& quality) const = 0;
};

}  // namespace shoal::scenarios
