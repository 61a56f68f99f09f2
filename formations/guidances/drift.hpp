#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shoal/formations/guidance.hpp"

namespace shoal::formations {

struct DriftOptions {
  enum class Slip : std::uint8_t { not_closing, receding };

  double speed_m_s = 1.0;
  double capture_radius_m = 3.0;
  double slip_radius_m = 10.0;
  double drifting_radius_m = 20.0;
  Slip slip = Slip::not_closing;
  double end_speed_scale = 0.5;
  std::int64_t targets_filter_size = 1;
  double period_s = 0.25;

  static void declare(Options<DriftOptions>& o);
  std::optional<std::string> complaint() const;
};

/// Steers to the target, then lets the vehicle drift: Rypkema 2015, sec. 3.2, Alg. 1-2, Table 3.1.
///
/// Algorithm 1 as printed has no memory of having arrived and would thrust again between the slip
/// and the drifting radius. Section 3.2 describes the latch that is here: once arrived, the vehicle
/// drifts until it leaves the drifting radius, also when the target moves inside it.
class Drift final : public Guidance {
 public:
  /// Throws InputError if the radii do not grow.
  explicit Drift(const DriftOptions& options = {});

  Command command(const Target&, const Eigen::Vector2d& to_target, const OwnState&,
                  Memory* memory) const override;
  std::unique_ptr<Memory> new_memory() const override;
  double period_s() const override { return options_.period_s; }
  double highest_speed_m_s() const override { return options_.speed_m_s; }
  std::optional<double> drifting_radius_m() const override { return options_.drifting_radius_m; }

 private:
  struct State {
    bool drifting = true;
    double previous_distance_m = std::numeric_limits<double>::infinity();
    std::vector<Eigen::Vector2d> recent_targets;
  };

  Command steer(const Eigen::Vector2d& to_target, State& state) const;

  DriftOptions options_;
};

}  // namespace shoal::formations
