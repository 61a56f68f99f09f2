#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "shoal/analysis/statistics/intervals.hpp"

namespace shoal::analysis {

/// One number for each row of a design; nothing where the trial failed or has no such number.
using Answers = std::span<const std::optional<double>>;

/// An estimate and how well it is known.
struct IndexEstimate {
  double value = 0.0;
  /// Nothing where resamples say nothing about the scatter (see `bootstrap`).
  std::optional<statistics::Interval> interval;

  /// Whether the interval leaves out zero.
  bool distinguishable() const { return interval && (interval->low > 0.0 || interval->high < 0.0); }
};

struct Resampling {
  double level = 0.95;   ///< confidence of the intervals
  int resamples = 1000;  ///< as Efron and Tibshirani 1993, ch. 13, advise for percentiles
  std::uint64_t seed = 1;
};

/// Estimates from the means of some numbers over samples, or nothing where they are not defined.
using OfMeans = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd& means)>;

/// Estimates with their percentile intervals (Efron and Tibshirani 1993, ch. 13). `samples` has one
/// column for each independent sample, which is drawn or left out as a whole.
///
/// There are no intervals from a single sample, nor where some resample defines no estimates. All
/// throw std::invalid_argument unless 0 < level < 1 and resamples > 0, and if the samples
/// themselves define no estimates.
std::vector<IndexEstimate> bootstrap(const Eigen::MatrixXd& samples, const OfMeans& of_means,
                                     const Resampling& resampling);

/// The same for estimates that also depend on how often each of some seeds counts.
using OfWeightedMeans = std::function<std::optional<Eigen::VectorXd>(
    const Eigen::VectorXd& means, const Eigen::VectorXd& seed_weights)>;

/// The same for samples that were all met under the same seeds: a resample draws samples and, from
/// three seeds on, seeds, until two of these differ (the pigeonhole bootstrap, Owen 2007).
std::vector<IndexEstimate> crossed_bootstrap(const Eigen::MatrixXd& samples, Eigen::Index seeds,
                                             const OfWeightedMeans& of_means,
                                             const Resampling& resampling);

/// Throws std::invalid_argument if an answer is not finite.
void require_finite(Answers answers);

}  // namespace shoal::analysis
