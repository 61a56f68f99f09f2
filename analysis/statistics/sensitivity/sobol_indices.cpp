#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "shoal/analysis/statistics/sensitivity/sobol_moments.hpp"

namespace shoal::analysis {
namespace {

// Of the size of the answers: what the rounding of a few operations may amount to.
constexpr double rounding = 10.0 * std::numeric_limits<double>::epsilon();

/// Whether answers to A and B (first and last row) all agree.
bool constant(const Eigen::MatrixXd& answers) {
  const Eigen::Index b = answers.rows() - 1;
  const double low = std::min(answers.row(0).minCoeff(), answers.row(b).minCoeff());
  const double high = std::max(answers.row(0).maxCoeff(), answers.row(b).maxCoeff());
  return high - low <= rounding * std::max(std::abs(low), std::abs(high));
}

/// Of each seed, rows of the design x the base samples with all their answers.
std::vector<Eigen::MatrixXd> complete_samples(const AnswersBySeed& answers, std::size_t rows) {
  std::vector<std::size_t> complete;  // where they begin
  for (std::size_t j = 0; j < answers.front().size(); j += rows) {
    const bool all = std::ranges::all_of(answers, [&](const auto& of_seed) {
      return std::ranges::all_of(Answers(of_seed).subspan(j, rows),
                                 [](const auto& y) { return y.has_value(); });
    });
    if (all) complete.push_back(j);
  }
  std::vector<Eigen::MatrixXd> seeds;
  for (const auto& of_seed : answers) {
    Eigen::MatrixXd& samples = seeds.emplace_back(static_cast<Eigen::Index>(rows),
                                                  static_cast<Eigen::Index>(complete.size()));
    for (std::size_t j = 0; j < complete.size(); ++j) {
      for (std::size_t r = 0; r < rows; ++r) {
        samples(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(j)) =
            *of_seed[complete[j] + r];
      }
    }
  }
  return seeds;
}

std::size_t rows_of_sample(const AnswersBySeed& answers, SaltelliRows design) {
  if (design.factors < 1) throw std::invalid_argument("Sobol' indices need a factor");
  if (answers.empty()) throw std::invalid_argument("Sobol' indices need a seed");
  const auto rows = static_cast<std::size_t>(design.count());
  for (const auto& of_seed : answers) {
    if (of_seed.size() % rows != 0 || of_seed.size() != answers.front().size()) {
      throw std::invalid_argument("the answers are not those of whole base samples");
    }
    require_finite(of_seed);
  }
  return rows;
}

}  // namespace

SobolIndices sobol_indices(const AnswersBySeed& answers, SaltelliRows rows,
                           const Resampling& resampling) {
  const std::size_t of_sample = rows_of_sample(answers, rows);
  std::vector<Eigen::MatrixXd> complete = complete_samples(answers, of_sample);
  SobolIndices result;
  result.base_samples = static_cast<int>(complete.front().cols());
  result.left_out = static_cast<int>(answers.front().size() / of_sample) - result.base_samples;
  if (result.base_samples < 2) {
    result.undefined = "fewer than two base samples have all their answers";
    return result;
  }
  if (std::ranges::all_of(complete, constant)) {
    result.undefined = "the answers to the base samples do not vary";
    return result;
  }
  for (Eigen::MatrixXd& of_seed : complete) {
    of_seed.array() -= (of_seed.row(0).mean() + of_seed.row(of_seed.rows() - 1).mean()) / 2.0;
  }
  const SobolMoments moments(rows, static_cast<int>(answers.size()));
  const Eigen::MatrixXd samples = moments.of(complete);
  const OfWeightedMeans of_means = [&](const Eigen::VectorXd& means, const Eigen::VectorXd& seeds) {
    return moments.indices(means, seeds);
  };
  const auto seeds = static_cast<Eigen::Index>(answers.size());
  if (!of_means(samples.rowwise().mean(), Eigen::VectorXd::Ones(seeds))) {
    result.undefined = "the mean over seeds does not vary, for all that the seeds show";
    return result;
  }
  const std::vector<IndexEstimate> estimates =
      crossed_bootstrap(samples, seeds, of_means, resampling);
  std::size_t at = 0;
  for (int i = 0; i < rows.factors; ++i, at += 2) {
    result.factors.push_back({.first_order = estimates[at], .total = estimates[at + 1]});
  }
  if (!rows.second_order) return result;
  for (int i = 0; i < rows.factors; ++i) {
    for (int j = i + 1; j < rows.factors; ++j) result.pairs.push_back({i, j, estimates[at++]});
  }
  return result;
}

std::vector<SobolIndices> sobol_convergence(const AnswersBySeed& answers, SaltelliRows rows,
                                            const Resampling& resampling) {
  const std::size_t of_sample = rows_of_sample(answers, rows);
  const std::size_t base_samples = answers.front().size() / of_sample;
  std::vector<SobolIndices> steps;
  for (const std::size_t part : {8U, 4U, 2U, 1U}) {
    const std::size_t n = base_samples / part;
    if (n == 0) continue;
    AnswersBySeed first = answers;
    for (auto& of_seed : first) of_seed.resize(n * of_sample);
    steps.push_back(sobol_indices(first, rows, resampling));
  }
  return steps;
}

}  // namespace shoal::analysis
