#include "shoal/analysis/statistics/survival.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

void require_times(EventTimes times) {
  for (const EventTime& each : times) {
    if (!(each.time >= 0.0 && std::isfinite(each.time))) {
      throw std::invalid_argument("the time of an event is negative or not finite");
    }
  }
}

double longest(EventTimes times) {
  double longest = 0.0;
  for (const EventTime& each : times) longest = std::max(longest, each.time);
  return longest;
}

/// Infinite if the longest of the times is that of an event, and of no watch that ended then.
double horizon_of(EventTimes times) {
  const double last = longest(times);
  const auto ended = [&](const EventTime& each) { return !each.reached && each.time == last; };
  return std::ranges::any_of(times, ended) ? last : std::numeric_limits<double>::infinity();
}

/// The area below the survival curve from `from` to `horizon`; beyond its last time it goes on.
double area(const std::vector<SurvivalStep>& steps, double from, double horizon) {
  double sum = 0.0, surviving = 1.0, begin = from;
  for (const SurvivalStep& step : steps) {
    if (step.time > begin) {
      const double end = std::min(step.time, horizon);
      sum += surviving * std::max(0.0, end - begin);
      begin = std::max(begin, end);
    }
    surviving = step.surviving;
  }
  // A curve that has come to zero has no more area, however far the horizon.
  if (surviving > 0.0 && horizon > begin) sum += surviving * (horizon - begin);
  return sum;
}

struct Watched {
  int at_risk = 0, events = 0;
};
Watched watched_at(double time, EventTimes times) {
  Watched watched;
  for (const EventTime& each : times) {
    if (each.time >= time) ++watched.at_risk;
    if (each.time == time && each.reached) ++watched.events;
  }
  return watched;
}

}  // namespace

std::vector<SurvivalStep> kaplan_meier(EventTimes times) {
  require_times(times);
  std::set<double> events;
  for (const EventTime& each : times) {
    if (each.reached) events.insert(each.time);
  }
  std::vector<SurvivalStep> steps;
  double surviving = 1.0, greenwood = 0.0;
  for (const double time : events) {
    const auto [at_risk, came] = watched_at(time, times);
    const double left = at_risk - came;
    surviving *= left / at_risk;
    if (left > 0.0) greenwood += came / (at_risk * left);
    steps.push_back({time, at_risk, came, surviving, surviving * surviving * greenwood});
  }
  return steps;
}

double common_horizon(std::span<const std::vector<EventTime>> samples) {
  double horizon = std::numeric_limits<double>::infinity();
  for (const std::vector<EventTime>& sample : samples) {
    require_times(sample);
    horizon = std::min(horizon, horizon_of(sample));
  }
  return horizon;
}

std::optional<RestrictedMean> restricted_mean(EventTimes times, double horizon) {
  const std::vector<SurvivalStep> steps = kaplan_meier(times);
  if (times.empty() || !(horizon <= horizon_of(times))) return std::nullopt;
  RestrictedMean result{.mean = area(steps, 0.0, horizon)};
  for (const SurvivalStep& step : steps) {
    const double left = step.at_risk - step.events;
    if (step.time >= horizon || left <= 0.0) continue;
    const double beyond = area(steps, step.time, horizon);
    result.variance += beyond * beyond * step.events / (step.at_risk * left);
  }
  return result;
}

std::vector<double> restricted_times(EventTimes times, double horizon) {
  require_times(times);
  if (!times.empty() && !(horizon <= horizon_of(times))) {
    throw std::invalid_argument("a horizon lies beyond what is known of survival");
  }
  std::vector<double> restricted;
  const auto known = [&](const EventTime& each) { return each.reached || each.time >= horizon; };
  if (std::ranges::all_of(times, known)) {
    for (const EventTime& each : times) restricted.push_back(std::min(each.time, horizon));
    return restricted;
  }
  const auto n = static_cast<double>(times.size());
  const double all = area(kaplan_meier(times), 0.0, horizon);
  std::vector<EventTime> others(times.begin() + 1, times.end());
  for (std::size_t i = 0; i < times.size(); ++i) {
    restricted.push_back(n * all - (n - 1.0) * area(kaplan_meier(others), 0.0, horizon));
    if (i < others.size()) others[i] = times[i];
  }
  return restricted;
}

std::optional<LogRank> log_rank(std::span<const std::vector<EventTime>> samples) {
  std::set<double> events;
  for (const std::vector<EventTime>& sample : samples) {
    require_times(sample);
    for (const EventTime& each : sample) {
      if (each.reached) events.insert(each.time);
    }
  }
  const auto k = static_cast<Eigen::Index>(samples.size());
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(k), expected = excess;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(k, k);
  for (const double time : events) {
    Eigen::VectorXd at_risk(k), came(k);
    for (Eigen::Index j = 0; j < k; ++j) {
      const Watched watched = watched_at(time, samples[static_cast<std::size_t>(j)]);
      at_risk[j] = watched.at_risk;
      came[j] = watched.events;
    }
    const double all = at_risk.sum(), died = came.sum();
    const Eigen::VectorXd share = at_risk / all;
    expected += died * share;
    excess += came - died * share;
    if (all > 1.0) {
      covariance += died * (all - died) / (all - 1.0) *
                    (Eigen::MatrixXd(share.asDiagonal()) - share * share.transpose());
    }
  }
  std::vector<Eigen::Index> counting;
  for (Eigen::Index j = 0; j < k; ++j) {
    if (expected[j] > 0.0) counting.push_back(j);
  }
  if (counting.size() < 2) return std::nullopt;
  counting.pop_back();  // the excesses sum up to zero
  const Eigen::VectorXd some = excess(counting);
  const Eigen::LDLT<Eigen::MatrixXd> solver(covariance(counting, counting));
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0.0)) return std::nullopt;
  LogRank result{some.dot(solver.solve(some)), static_cast<int>(counting.size()), 1.0};
  const boost::math::chi_squared null(result.degrees);
  result.p_value = cdf(complement(null, std::max(0.0, result.chi_squared)));
  return result;
}

}  // namespace shoal::analysis::statistics
