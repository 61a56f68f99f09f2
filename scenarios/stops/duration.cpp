#include "shoal/scenarios/stops/stop_rule.hpp"

namespace shoal::scenarios {
namespace {

struct Duration final : StopRule {
  bool watches() const override { return false; }
  bool needs_quality() const override { return false; }
  std::optional<std::string> refuses_quality_every(double) const override { return std::nullopt; }
  bool met(const QualitySoFar&) const override { return false; }

  static void declare(Options<Duration>&) {}
};

const Register<StopRule, Duration> registered{"duration", "never: after trial.duration_s"};

}  // namespace
}  // namespace shoal::scenarios
