#include "shoal/analysis/statistics/sensitivity/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shoal/analysis/statistics/summary.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis {
namespace {

Eigen::VectorXd means_of_resample(const Eigen::MatrixXd& samples, std::uint64_t seed,
                                  std::uint32_t resample) {
  const RandomStreams random(seed);
  const auto n = static_cast<double>(samples.cols());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(samples.rows());
  const auto add = [&](double u) { sum += samples.col(static_cast<Eigen::Index>(u * n)); };
  for (Eigen::Index i = 0; i < samples.cols(); i += 2) {
    const auto [u, v] =
        random.uniform(Purpose::bootstrap, resample, static_cast<std::uint64_t>(i / 2));
    add(u);
    if (i + 1 < samples.cols()) add(v);
  }
  return sum / n;
}

/// How often each seed is drawn; each once, where too few would be left.
Eigen::VectorXd weights_of_resample(Eigen::Index seeds, std::uint64_t seed,
                                    std::uint32_t resample) {
  if (seeds < 3) return Eigen::VectorXd::Ones(seeds);
  constexpr std::uint64_t apart = std::uint64_t{1} << 40;  // from the draws of samples
  const RandomStreams random(seed);
  for (std::uint64_t draw = apart;;) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(seeds);
    for (Eigen::Index i = 0; i < seeds; ++i) {
      const double u = random.uniform(Purpose::bootstrap, resample, draw++)[0];
      weights[static_cast<Eigen::Index>(u * static_cast<double>(seeds))] += 1.0;
    }
    if (weights.maxCoeff() < static_cast<double>(seeds)) return weights;
  }
}

}  // namespace

std::vector<IndexEstimate> bootstrap(const Eigen::MatrixXd& samples, const OfMeans& of_means,
                                     const Resampling& resampling) {
  const auto unweighted = [&](const Eigen::VectorXd& means, const Eigen::VectorXd&) {
    return of_means(means);
  };
  return crossed_bootstrap(samples, 1, unweighted, resampling);
}

std::vector<IndexEstimate> crossed_bootstrap(const Eigen::MatrixXd& samples, Eigen::Index seeds,
                                             const OfWeightedMeans& of_means,
                                             const Resampling& resampling) {
  if (!(resampling.level > 0.0 && resampling.level < 1.0)) {
    throw std::invalid_argument("a confidence level is not between 0 and 1");
  }
  if (resampling.resamples < 1) throw std::invalid_argument("a bootstrap needs resamples");
  const std::optional<Eigen::VectorXd> values =
      of_means(samples.rowwise().mean(), Eigen::VectorXd::Ones(seeds));
  if (!values) throw std::invalid_argument("the samples of a bootstrap define no estimates");

  std::vector<IndexEstimate> estimates;
  for (const double value : *values) estimates.push_back({.value = value});
  if (samples.cols() < 2) return estimates;

  Eigen::MatrixXd replicates(resampling.resamples, values->size());
  for (Eigen::Index b = 0; b < replicates.rows(); ++b) {
    const auto number = static_cast<std::uint32_t>(b);
    const auto replicate = of_means(means_of_resample(samples, resampling.seed, number),
                                    weights_of_resample(seeds, resampling.seed, number));
    if (!replicate) return estimates;
    replicates.row(b) = replicate->transpose();
  }
  const double tail = (1.0 - resampling.level) / 2.0;
  for (std::size_t e = 0; e < estimates.size(); ++e) {
    const auto column = replicates.col(static_cast<Eigen::Index>(e));
    const statistics::Sample sample(column.data(), static_cast<std::size_t>(column.size()));
    estimates[e].interval = {.low = statistics::quantile(sample, tail),
                             .high = statistics::quantile(sample, 1.0 - tail)};
  }
  return estimates;
}

void require_finite(Answers answers) {
  const auto finite = [](const std::optional<double>& y) { return !y || std::isfinite(*y); };
  if (!std::ranges::all_of(answers, finite)) {
    throw std::invalid_argument("an answer of a design is not finite");
  }
}

}  // namespace shoal::analysis
