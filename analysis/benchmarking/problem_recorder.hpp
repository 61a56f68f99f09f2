#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "shoal/analysis/benchmarking/corpus.hpp"
#include "shoal/analysis/benchmarking/packed_situations.hpp"
#include "shoal/formations/planner.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

/// Notes situations in which a vehicle solved problems. The trial's numbers do not change.
///
/// Of each vehicle at most `most` are kept, and once there are more, every second, fourth ... one,
/// so that they stay evenly spread over time: planning at every tick, a vehicle has tens of
/// thousands an hour.
class ProblemRecorder {
 public:
  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

  explicit ProblemRecorder(std::size_t most = all) : most_(most) {}

  /// For TrialSettings::plan_observer. One recorder serves one trial, and outlives it.
  std::function<formations::PlanObserver&(std::size_t vehicle)> of_trial();

  /// What was noted, vehicle by vehicle, in the order of time.
  Corpus corpus(const scenarios::Scenario& scenario, const std::string& name,
                const formations::Plan& plan) const;

  /// Also those that were not kept.
  std::size_t situations() const;

 private:
  class OfVehicle final : public formations::PlanObserver {
   public:
    OfVehicle(std::size_t most, LargeBlocks& blocks) : most_(most), kept_(blocks) {}

    /// The situation is noted, and not the problem, which it states again.
    Wants wants() const override { return {.problems = false, .times = false}; }
    void answered(const solvers::Answer&, double) override { solved_ = true; }
    void planned(const formations::Neighbourhood& seen, const formations::Target&) override;

    const PackedSituations& kept() const { return kept_; }
    std::size_t situations() const { return situations_; }

   private:
    const std::size_t most_;
    PackedSituations kept_;
    std::size_t stride_ = 1;
    std::size_t next_ = 0;  // of the situations, to be kept
    std::size_t situations_ = 0;
    bool solved_ = false;  // a problem, since the last plan
  };

  const std::size_t most_;
  LargeBlocks blocks_;
  std::deque<OfVehicle> vehicles_;  // stay where they are
};

}  // namespace shoal::analysis
