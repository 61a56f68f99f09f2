#pragma once

#include "shoal/formations/conditioning.hpp"
#include "shoal/formations/guidance.hpp"

namespace shoal::formations {

struct ConditionedForceOptions {
  double period_s = 0.25;
  PerformanceEnvelope envelope;

  static void declare(Options<ConditionedForceOptions>& o);
};

/// Makes a force per unit of mass admissible, and asks for the heading and speed that it leads to
/// within one period: Barisic et al. 2011, sec. 5.4. While a vehicle holds, it drifts.
class ConditionedForce final : public Guidance {
 public:
  /// Throws InputError if the envelope contradicts itself.
  explicit ConditionedForce(const ConditionedForceOptions& options = {});

  Command command(const Target& target, const Eigen::Vector2d&, const OwnState& own,
                  Memory*) const override;
  double period_s() const override { return options_.period_s; }
  bool takes_forces() const override { return true; }
  bool needs_motion() const override { return true; }
  double highest_speed_m_s() const override { return options_.envelope.speed_max_m_s; }

 private:
  ConditionedForceOptions options_;
};

}  // namespace shoal::formations
