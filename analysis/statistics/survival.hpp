#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shoal/analysis/statistics/sample.hpp"

namespace shoal::analysis::statistics {

// Times to an event that some trials never see while they are watched (right-censored times). To
// leave those trials out would favour what fails; these statistics count them for what they are:
// later than the end of their watch.

struct EventTime {
  double time = 0.0;    ///< of the event, or the end of the watch; at least 0
  bool reached = true;  ///< whether the event came
};
using EventTimes = std::span<const EventTime>;

/// Just after the time of one or more events.
struct SurvivalStep {
  double time = 0.0;
  int at_risk = 0;  ///< watched, and without the event, just before
  int events = 0;
  double surviving = 1.0;  ///< the share without the event (Kaplan and Meier 1958)
  double variance = 0.0;   ///< of that share (Greenwood 1926)
};

/// Ascending. Watches that end at the time of an event count as having lasted through it. All
/// functions here throw std::invalid_argument if a time is negative or not finite.
std::vector<SurvivalStep> kaplan_meier(EventTimes times);

/// How far every one of these samples knows its survival: the least of their longest times, of
/// those samples whose longest time is the end of a watch; infinite if there is none.
double common_horizon(std::span<const std::vector<EventTime>> samples);

/// The mean of the lesser of the time and a horizon: the area below the survival curve.
struct RestrictedMean {
  double mean = 0.0;
  double variance = 0.0;  ///< of the mean (Klein and Moeschberger 2003, eq. 4.5.3)
};
/// Nothing without times, and for a horizon beyond what the sample knows.
std::optional<RestrictedMean> restricted_mean(EventTimes times, double horizon);

/// Of each time, what it contributes to the restricted mean: its pseudo-value, n times the mean
/// less n - 1 times that without it (Andersen, Hansen and Klein 2004). Where no watch ended before
/// the horizon, just the lesser of the time and the horizon. For means and paired differences of
/// restricted times. Throws std::invalid_argument for a horizon beyond what the sample knows.
std::vector<double> restricted_times(EventTimes times, double horizon);

struct LogRank {
  double chi_squared = 0.0;
  int degrees = 0;
  double p_value = 1.0;
};
/// Whether the events of independent samples come at the same rate (Mantel 1966; Klein and
/// Moeschberger 2003, sec. 7.3). Samples that had no chance of an event do not count. Nothing if
/// fewer than two are left.
std::optional<LogRank> log_rank(std::span<const std::vector<EventTime>> samples);

}  // namespace shoal::analysis::statistics
