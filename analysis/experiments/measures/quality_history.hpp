#pragma once

#include <optional>
#include <span>

namespace shoal::analysis {

/// What a formation quality measured at instants of a mission says as a whole. Shares of the
/// mission are from 0 to 1; nothing is said where there is no instant (or are too few).
class QualityHistory {
 public:
  QualityHistory(std::span<const double> time_s, std::span<const double> quality_m,
                 double mission_s)
      : time_s_(time_s), quality_m_(quality_m), mission_s_(mission_s) {}

  std::optional<double> mean_m(double from_share) const;
  std::optional<double> worst_m(double from_share) const;
  /// Slope of the least-squares line.
  std::optional<double> trend_m_per_h(double from_share) const;

  /// How strongly the quality of the formed swarm swings throughout: its rms about its own mean
  /// over 10 minutes centred on each instant. Waves shorter than that count, drift and slow
  /// settling do not. The swarm is formed from when the quality first is at most 1.5 times its mean
  /// in the last 60 % of the mission.
  std::optional<double> oscillation_m() const;

  /// How much the quality rises and falls again while the formed swarm comes to rest: the lesser of
  /// the sums of its rises and of its falls, in the 10 minutes after the swarm has formed. Whatever
  /// goes one way only counts nothing.
  std::optional<double> swing_m() const;

 private:
  std::size_t first_at(double share) const;
  /// Nothing if there is no mean to compare with.
  std::optional<std::size_t> formed_at() const;

  std::span<const double> time_s_, quality_m_;
  double mission_s_;
};

}  // namespace shoal::analysis
