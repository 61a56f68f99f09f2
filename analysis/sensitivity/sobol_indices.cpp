#include "shoal/analysis/sensitivity/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace shoal::analysis {
namespace {

// Of the size of the answers: what the rounding of a few operations may amount to.
constexpr double rounding = 10.0 * std::numeric_limits<double>::epsilon();
// A resample with less variance than this, relative to its mean square, is all one value.
constexpr double rounding_of_sums = 1e-12;

/// Whether answers to A and B (first and last row) all agree.
bool constant(const Eigen::MatrixXd& answers) {
  const Eigen::Index b = answers.rows() - 1;
  const double low = std::min(answers.row(0).minCoeff(), answers.row(b).minCoeff());
  const double high = std::max(answers.row(0).maxCoeff(), answers.row(b).maxCoeff());
  return high - low <= rounding * std::max(std::abs(low), std::abs(high));
}

/// Rows A, AB_1 ... AB_k, B; a column for each base sample with all its answers.
Eigen::MatrixXd complete_samples(Answers answers, std::size_t rows) {
  std::vector<double> complete;
  for (std::size_t j = 0; j < answers.size(); j += rows) {
    const Answers sample = answers.subspan(j, rows);
    if (!std::ranges::all_of(sample, [](const auto& y) { return y.has_value(); })) continue;
    for (const auto& y : sample) complete.push_back(*y);
  }
  return Eigen::Map<Eigen::MatrixXd>(complete.data(), static_cast<Eigen::Index>(rows),
                                     static_cast<Eigen::Index>(complete.size() / rows));
}

/// Of each base sample, the numbers whose means the estimators are made of. With a, b and c the
/// answers to A, B and AB_i: (a + b) / 2, (a^2 + b^2) / 2, and for each factor
/// b (c - a), c - a, (c - a)^2 / 2.
Eigen::MatrixXd moments(const Eigen::MatrixXd& answers) {
  const Eigen::Index k = answers.rows() - 2;
  const Eigen::ArrayXXd y = answers.array();
  const Eigen::ArrayXXd a = y.row(0), b = y.row(k + 1);
  Eigen::MatrixXd moments(2 + 3 * k, answers.cols());
  moments.row(0) = (a + b) / 2.0;
  moments.row(1) = (a.square() + b.square()) / 2.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::ArrayXXd change = y.row(1 + i) - a;
    moments.row(2 + 3 * i) = b * change;
    moments.row(3 + 3 * i) = change;
    moments.row(4 + 3 * i) = change.square() / 2.0;
  }
  return moments;
}

/// First-order and total index of each factor in turn, from the means of `moments`.
std::optional<Eigen::VectorXd> indices(const Eigen::VectorXd& means) {
  const double mean = means[0];
  const double variance = means[1] - mean * mean;
  if (variance <= rounding_of_sums * means[1]) return std::nullopt;
  const Eigen::Index k = (means.size() - 2) / 3;
  Eigen::VectorXd indices(2 * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    // The mean of (b - mean) (c - a), so that every resample is centred on its own mean.
    indices[2 * i] = (means[2 + 3 * i] - mean * means[3 + 3 * i]) / variance;
    indices[2 * i + 1] = means[4 + 3 * i] / variance;
  }
  return indices;
}

std::size_t rows_of_sample(Answers answers, int factors) {
  if (factors < 1) throw std::invalid_argument("Sobol' indices need a factor");
  const auto rows = static_cast<std::size_t>(factors) + 2;
  if (answers.size() % rows != 0) {
    throw std::invalid_argument("the answers are not those of whole base samples");
  }
  require_finite(answers);
  return rows;
}

}  // namespace

SobolIndices sobol_indices(Answers answers, int factors, const Resampling& resampling) {
  const std::size_t rows = rows_of_sample(answers, factors);
  Eigen::MatrixXd complete = complete_samples(answers, rows);
  SobolIndices result;
  result.base_samples = static_cast<int>(complete.cols());
  result.left_out = static_cast<int>(answers.size() / rows) - result.base_samples;
  if (result.base_samples < 2) {
    result.undefined = "fewer than two base samples have all their answers";
    return result;
  }
  if (constant(complete)) {
    result.undefined = "the answers to the base samples do not vary";
    return result;
  }
  const Eigen::Index b = complete.rows() - 1;
  complete.array() -= (complete.row(0).mean() + complete.row(b).mean()) / 2.0;
  const std::vector<IndexEstimate> estimates = bootstrap(moments(complete), indices, resampling);
  for (std::size_t i = 0; i < estimates.size(); i += 2) {
    result.factors.push_back({.first_order = estimates[i], .total = estimates[i + 1]});
  }
  return result;
}

std::vector<SobolIndices> sobol_convergence(Answers answers, int factors,
                                            const Resampling& resampling) {
  const std::size_t rows = rows_of_sample(answers, factors);
  const std::size_t base_samples = answers.size() / rows;
  std::vector<SobolIndices> steps;
  for (const std::size_t part : {8U, 4U, 2U, 1U}) {
    const std::size_t n = base_samples / part;
    if (n == 0) continue;
    steps.push_back(sobol_indices(answers.first(n * rows), factors, resampling));
  }
  return steps;
}

}  // namespace shoal::analysis
