#include "shoal/analysis/experiments/measures/quality_history.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

constexpr double half_window_s = 300.0;
constexpr double to_rest_s = 600.0;
constexpr double formed_ratio = 1.5;

double mean_over(std::span<const double> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

}  // namespace

std::size_t QualityHistory::first_at(double share) const {
  const auto first = std::ranges::lower_bound(time_s_, share * mission_s_);
  return static_cast<std::size_t>(first - time_s_.begin());
}

std::optional<double> QualityHistory::mean_m(double from_share) const {
  const auto rest = quality_m_.subspan(first_at(from_share));
  if (rest.empty()) return std::nullopt;
  return mean_over(rest);
}

std::optional<double> QualityHistory::worst_m(double from_share) const {
  const auto rest = quality_m_.subspan(first_at(from_share));
  if (rest.empty()) return std::nullopt;
  return std::ranges::max(rest);
}

std::optional<double> QualityHistory::trend_m_per_h(double from_share) const {
  const auto time = time_s_.subspan(first_at(from_share));
  const auto quality = quality_m_.subspan(first_at(from_share));
  if (time.size() < 2) return std::nullopt;
  const double t = mean_over(time), q = mean_over(quality);
  double rise = 0.0, width = 0.0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    rise += (time[k] - t) * (quality[k] - q);
    width += (time[k] - t) * (time[k] - t);
  }
  return 3600.0 * rise / width;
}

std::optional<std::size_t> QualityHistory::formed_at() const {
  const std::optional<double> settled = mean_m(settled_from);
  if (!settled) return std::nullopt;
  const auto formed =
      std::ranges::find_if(quality_m_, [&](double q) { return q <= formed_ratio * *settled; });
  return static_cast<std::size_t>(formed - quality_m_.begin());
}

std::optional<double> QualityHistory::oscillation_m() const {
  const std::optional<std::size_t> formed = formed_at();
  if (!formed) return std::nullopt;
  double sum = 0.0;
  std::size_t count = 0, begin = *formed, end = *formed;
  for (std::size_t k = *formed; k < time_s_.size(); ++k) {
    // Only where the whole window lies in the mission and after the forming.
    if (time_s_[k] - time_s_[*formed] < half_window_s ||
        time_s_.back() - time_s_[k] < half_window_s) {
      continue;
    }
    while (time_s_[k] - time_s_[begin] > half_window_s) ++begin;
    while (end < time_s_.size() && time_s_[end] - time_s_[k] <= half_window_s) ++end;
    const double residual = quality_m_[k] - mean_over(quality_m_.subspan(begin, end - begin));
    sum += residual * residual;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

std::optional<double> QualityHistory::swing_m() const {
  const std::optional<std::size_t> formed = formed_at();
  if (!formed) return std::nullopt;
  const double until_s = time_s_[*formed] + to_rest_s;
  if (time_s_.back() < until_s) return std::nullopt;
  double rises = 0.0, falls = 0.0;
  for (std::size_t k = *formed + 1; k < time_s_.size() && time_s_[k] <= until_s; ++k) {
    const double step = quality_m_[k] - quality_m_[k - 1];
    (step > 0.0 ? rises : falls) += std::abs(step);
  }
  return std::min(rises, falls);
}

}  // namespace shoal::analysis
