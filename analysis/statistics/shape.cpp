#include "shoal/analysis/statistics/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr int null_samples = 1999;
constexpr std::size_t largest_simulated = 1000;

std::vector<double> ordered(Sample values) {
  require_finite(values);
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

/// A corner of the sample's distribution function, counted in values.
struct Corner {
  double x = 0.0, count = 0.0;
};

/// The corners of the greatest convex function below points in order, or of the least concave one
/// above them (for `sign` -1).
std::vector<Corner> hull(const std::vector<Corner>& points, double sign) {
  std::vector<Corner> kept;
  for (const Corner& point : points) {
    while (kept.size() > 1) {
      const Corner& a = kept[kept.size() - 2];
      const Corner& b = kept.back();
      const double turn =
          (b.count - a.count) * (point.x - b.x) - (point.count - b.count) * (b.x - a.x);
      if (sign * turn < 0.0) break;
      kept.pop_back();
    }
    kept.push_back(point);
  }
  return kept;
}

double at(const std::vector<Corner>& line, double x) {
  const auto after = std::ranges::lower_bound(line, x, {}, &Corner::x);
  if (after == line.begin()) return line.front().count;
  if (after == line.end()) return line.back().count;
  const Corner& a = *(after - 1);
  return a.count + (after->count - a.count) * (x - a.x) / (after->x - a.x);
}

/// Of different values in order, in values: twice the dip times n.
///
/// The distribution function is a staircase; its lower corners carry the convex part of a function
/// with one mode, its upper corners the concave part. As long as these two are further apart
/// somewhere than each is from the staircase outside, the mode is within where they are furthest
/// apart, and the search goes on there.
double doubled_dip(const std::vector<double>& x) {
  std::size_t low = 0, high = x.size() - 1;
  double deepest = 1.0;
  while (low < high) {
    std::vector<Corner> lower, upper;  // at a value, the count below it and the count up to it
    for (std::size_t i = low; i <= high; ++i) {
      lower.push_back({x[i], static_cast<double>(i)});
      upper.push_back({x[i], static_cast<double>(i) + 1.0});
    }
    const std::vector<Corner> convex = hull(lower, 1.0), concave = hull(upper, -1.0);
    // The two are furthest apart at a corner of one of them.
    double gap = 0.0, from = x[low], to = x[high];
    for (const Corner& corner : convex) {
      const double apart = at(concave, corner.x) - corner.count;
      if (apart > gap) {
        gap = apart;
        from = corner.x;
        to = std::ranges::lower_bound(concave, from, {}, &Corner::x)->x;
      }
    }
    for (const Corner& corner : concave) {
      const double apart = corner.count - at(convex, corner.x);
      if (apart > gap) {
        gap = apart;
        to = corner.x;
        from = (std::ranges::upper_bound(convex, to, {}, &Corner::x) - 1)->x;
      }
    }
    if (gap <= deepest) break;
    for (std::size_t i = low; i <= high; ++i) {
      // How far the staircase is above the convex part, or below the concave one.
      if (x[i] <= from)
        deepest = std::max(deepest, static_cast<double>(i) + 1.0 - at(convex, x[i]));
      if (x[i] >= to) deepest = std::max(deepest, at(concave, x[i]) - static_cast<double>(i));
    }
    const auto new_low = static_cast<std::size_t>(std::ranges::lower_bound(x, from) - x.begin());
    const auto new_high = static_cast<std::size_t>(std::ranges::upper_bound(x, to) - x.begin()) - 1;
    if (new_low == low && new_high == high) break;
    low = new_low;
    high = new_high;
  }
  return deepest;
}

/// Ascending, of simulated samples of n; made once for each n.
template <class Of>
const std::vector<double>& simulated_values(std::size_t n, const Of& of) {
  static std::map<std::size_t, std::vector<double>> known;
  static std::mutex guard;
  const std::scoped_lock lock(guard);
  std::vector<double>& values = known[n];
  if (values.empty()) {
    for (std::uint32_t k = 0; k < null_samples; ++k) values.push_back(of(k));
    std::ranges::sort(values);
  }
  return values;
}

double p_value_among(double value, const std::vector<double>& null) {
  // Equal up to rounding is as large.
  const auto first = std::ranges::lower_bound(null, value * (1.0 - 1e-12));
  return (1.0 + static_cast<double>(null.end() - first)) / (null_samples + 1.0);
}

template <class Draw>
std::vector<double> drawn(std::size_t n, const Draw& draw) {
  std::vector<double> values;
  for (std::uint64_t i = 0; values.size() < n; ++i) {
    for (const double x : draw(i)) values.push_back(x);
  }
  values.resize(n);
  return values;
}

double g1(Sample values) {
  const double centre = mean(values), sd = standard_deviation(values);
  const auto n = static_cast<double>(values.size());
  double cubes = 0.0;
  for (const double x : values) cubes += std::pow((x - centre) / sd, 3);
  return cubes / n * std::pow(n / (n - 1.0), 1.5);
}

}  // namespace

std::optional<double> dip(Sample values) {
  const std::vector<double> x = ordered(values);
  if (x.empty() || std::ranges::adjacent_find(x) != x.end()) return std::nullopt;
  return doubled_dip(x) / (2.0 * static_cast<double>(x.size()));
}

std::optional<double> dip_p_value(Sample values) {
  const std::optional<double> found = dip(values);
  if (!found || values.size() < 4) return std::nullopt;
  // Beyond, the root of n times the dip hardly depends on n.
  const std::size_t n = std::min(values.size(), largest_simulated);
  const double as_of_n = std::sqrt(static_cast<double>(values.size()) / static_cast<double>(n));
  const RandomStreams random(1985);
  return p_value_among(
      2.0 * static_cast<double>(n) * *found * as_of_n, simulated_values(n, [&](std::uint32_t k) {
        return doubled_dip(ordered(
            drawn(n, [&](std::uint64_t i) { return random.uniform(Purpose::bootstrap, k, i); })));
      }));
}

std::optional<double> skewness(Sample values) {
  if (values.size() < 3 || !standard_error(values)) return std::nullopt;
  return g1(values);
}

std::optional<double> skewness_p_value(Sample values) {
  const std::optional<double> found = skewness(values);
  if (!found) return std::nullopt;
  const std::size_t n = std::min(values.size(), largest_simulated);
  const double as_of_n = std::sqrt(static_cast<double>(values.size()) / static_cast<double>(n));
  const RandomStreams random(1930);
  return p_value_among(std::abs(*found) * as_of_n, simulated_values(n, [&](std::uint32_t k) {
                         return std::abs(g1(drawn(n, [&](std::uint64_t i) {
                           return random.normal(Purpose::bootstrap, k, i);
                         })));
                       }));
}

std::optional<TwoGroups> two_groups(Sample values) {
  if (!standard_error(values)) return std::nullopt;
  const std::vector<double> x = ordered(values);
  const double centre = mean(values);
  double all = 0.0, sum = 0.0;
  for (const double each : x) all += (each - centre) * (each - centre);
  const auto n = static_cast<double>(x.size());
  TwoGroups best;
  for (std::size_t k = 1; k < x.size(); ++k) {
    sum += x[k - 1] - centre;
    const auto below = static_cast<double>(k), above = n - below;
    // The means of both sides lie sum / below and -sum / above from the mean of all.
    const double between = sum * sum * (1.0 / below + 1.0 / above);
    if (x[k] == x[k - 1] || between <= best.explained * all) continue;
    best = {.low_n = static_cast<int>(k),
            .high_n = static_cast<int>(x.size() - k),
            .explained = between / all};
  }
  // From the numbers themselves: zeros have the mean zero.
  const auto low_n = static_cast<std::size_t>(best.low_n);
  best.low_mean = mean(Sample(x).first(low_n));
  best.high_mean = mean(Sample(x).subspan(low_n));
  return best;
}

}  // namespace shoal::analysis::statistics
