#include "shoal/analysis/statistics/intervals.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/summary.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

// Statistics that are closer than this, relative to the largest, differ by rounding only.
constexpr double same_statistic = 1e-12;

double tail_outside(double level) {
  if (!(level > 0.0 && level < 1.0)) {
    throw std::invalid_argument("a confidence level is not between 0 and 1");
  }
  return (1.0 - level) / 2.0;
}

template <class Of>
std::vector<double> replicates(Sample values, const Of& statistic,
                               const BootstrapOptions& options) {
  const RandomStreams random(options.seed);
  const auto n = static_cast<double>(values.size());
  const auto drawn = [&](double u) { return values[static_cast<std::size_t>(u * n)]; };
  std::vector<double> resample(values.size());
  std::vector<double> replicates(static_cast<std::size_t>(options.resamples));
  for (std::size_t b = 0; b < replicates.size(); ++b) {
    for (std::size_t i = 0; i < resample.size(); i += 2) {
      const auto [u, v] = random.uniform(Purpose::bootstrap, static_cast<std::uint32_t>(b), i / 2);
      resample[i] = drawn(u);
      if (i + 1 < resample.size()) resample[i + 1] = drawn(v);
    }
    replicates[b] = statistic(Sample(resample));
  }
  return replicates;
}

/// z0 of Efron and Tibshirani 1993, eq. 14.14: how far the estimate lies from the median of its
/// replicates.
std::optional<double> bias_correction(const std::vector<double>& replicates, double estimate) {
  const double largest = std::abs(*std::ranges::max_element(
      replicates, {}, [](double replicate) { return std::abs(replicate); }));
  double below = 0.0;
  for (const double replicate : replicates) {
    const double excess = replicate - estimate;
    if (std::abs(excess) <= same_statistic * largest) {
      below += 0.5;
    } else if (excess < 0.0) {
      below += 1.0;
    }
  }
  const double share = below / static_cast<double>(replicates.size());
  if (!(share > 0.0 && share < 1.0)) return std::nullopt;
  return quantile(boost::math::normal(), share);
}

/// a of Efron and Tibshirani 1993, eq. 14.15: a sixth of the skewness of the statistic with one
/// value left out.
template <class Of>
std::optional<double> acceleration(Sample values, const Of& statistic) {
  std::vector<double> others(values.begin() + 1, values.end());
  std::vector<double> without;
  for (std::size_t i = 0; i < values.size(); ++i) {
    without.push_back(statistic(Sample(others)));
    if (!std::isfinite(without.back())) return std::nullopt;
    if (i < others.size()) others[i] = values[i];
  }
  if (!standard_error(without)) return std::nullopt;

  const double centre = mean(without);
  double squares = 0.0, cubes = 0.0;
  for (const double x : without) squares += (centre - x) * (centre - x);
  for (const double x : without) cubes += std::pow((centre - x) / std::sqrt(squares), 3);
  return cubes / 6.0;
}

template <class Of>
std::optional<Interval> bca(Sample values, const Of& statistic, double level,
                            const BootstrapOptions& options) {
  const double z = quantile(complement(boost::math::normal(), tail_outside(level)));
  if (options.resamples < 1) throw std::invalid_argument("a bootstrap needs resamples");
  if (!standard_error(values)) return std::nullopt;

  const std::vector<double> resampled = replicates(values, statistic, options);
  const double estimate = statistic(values);
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(resampled, finite) || !finite(estimate)) return std::nullopt;
  const std::optional<double> z0 = bias_correction(resampled, estimate);
  const std::optional<double> a = acceleration(values, statistic);
  if (!z0 || !a) return std::nullopt;

  // Efron and Tibshirani 1993, eq. 14.10. Past the pole the formula means nothing.
  const auto end = [&](double z_nominal) -> std::optional<double> {
    const double shifted = *z0 + z_nominal;
    const double slack = 1.0 - *a * shifted;
    if (slack <= 0.0) return std::nullopt;
    return quantile(resampled, cdf(boost::math::normal(), *z0 + shifted / slack));
  };
  const std::optional<double> low = end(-z), high = end(z);
  if (!low || !high) return std::nullopt;
  return Interval{*low, *high};
}

}  // namespace

std::optional<Interval> t_interval(Sample values, double level) {
  const double tail = tail_outside(level);
  const std::optional<double> error = standard_error(values);
  if (!error) return std::nullopt;
  const boost::math::students_t t(static_cast<double>(values.size() - 1));
  const double half = quantile(complement(t, tail)) * *error;
  const double centre = mean(values);
  return Interval{centre - half, centre + half};
}

std::optional<Interval> bca_interval(Sample values, const Statistic& statistic, double level,
                                     const BootstrapOptions& options) {
  return bca(values, statistic, level, options);
}

std::optional<Interval> bca_interval_of_mean(Sample values, double level,
                                             const BootstrapOptions& options) {
  const auto plain_mean = [](Sample sample) {
    return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
  };
  return bca(values, plain_mean, level, options);
}

}  // namespace shoal::analysis::statistics
