#include "shoal/analysis/statistics/sensitivity/sobol_moments.hpp"

#include <cmath>

namespace shoal::analysis {
namespace {

// A resample with less variance than this, relative to its mean square, is all one value.
constexpr double rounding_of_sums = 1e-12;

/// The answers of one seed as the estimators use them: A, B and, for each factor, AB_i - A and
/// BA_i - B.
struct Effects {
  Eigen::ArrayXd a, b;
  std::vector<Eigen::ArrayXd> from_a, from_b;

  Effects(const Eigen::MatrixXd& answers, SaltelliRows rows)
      : a(answers.row(0).transpose()), b(answers.row(answers.rows() - 1).transpose()) {
    for (Eigen::Index i = 0; i < rows.factors; ++i) {
      from_a.emplace_back(answers.row(1 + i).transpose().array() - a);
      if (rows.second_order) {
        from_b.emplace_back(answers.row(1 + rows.factors + i).transpose().array() - b);
      }
    }
  }

  Eigen::ArrayXd mean() const { return (a + b) / 2.0; }
  /// Of a factor, over the sides that there are.
  Eigen::ArrayXd effect(std::size_t i) const {
    return from_b.empty() ? from_a[i] : Eigen::ArrayXd((from_a[i] + from_b[i]) / 2.0);
  }
};

/// b (c - a), or its mean with a (d - b): of answers of one seed with changes of the other.
Eigen::ArrayXd first_order(const Effects& x, const Effects& y, std::size_t i) {
  const Eigen::ArrayXd forth = x.b * y.from_a[i];
  return x.from_b.empty() ? forth : Eigen::ArrayXd((forth + x.a * y.from_b[i]) / 2.0);
}

Eigen::ArrayXd total(const Effects& x, const Effects& y, std::size_t i) {
  const Eigen::ArrayXd forth = x.from_a[i] * y.from_a[i] / 2.0;
  return x.from_b.empty() ? forth : Eigen::ArrayXd((forth + x.from_b[i] * y.from_b[i] / 2.0) / 2.0);
}

/// (d_i - b) (c_j - a) and with i and j swapped, over both ways to take the seeds.
Eigen::ArrayXd together(const Effects& x, const Effects& y, std::size_t i, std::size_t j) {
  return (x.from_b[i] * y.from_a[j] + y.from_b[i] * x.from_a[j] + x.from_b[j] * y.from_a[i] +
          y.from_b[j] * x.from_a[i]) /
         4.0;
}

/// Calls `visit` with the pairs of seeds that products are taken of.
template <class Visit>
void each_pair(int seeds, Visit visit) {
  if (seeds == 1) return visit(0, 0);
  for (int k = 0; k < seeds; ++k) {
    for (int l = k + 1; l < seeds; ++l) visit(k, l);
  }
}

}  // namespace

Eigen::MatrixXd SobolMoments::of(const std::vector<Eigen::MatrixXd>& answers) const {
  std::vector<Effects> seeds;
  for (const Eigen::MatrixXd& of_seed : answers) seeds.emplace_back(of_seed, rows_);
  const auto factors = static_cast<std::size_t>(rows_.factors);
  const int pairs = seeds_ == 1 ? 1 : seeds_ * (seeds_ - 1) / 2;
  Eigen::MatrixXd moments(seeds_ * of_a_seed() + pairs * of_a_pair(), answers.front().cols());
  Eigen::Index row = 0;
  const auto add = [&](const Eigen::ArrayXd& numbers) { moments.row(row++) = numbers.transpose(); };
  for (const Effects& seed : seeds) {
    add(seed.mean());
    for (std::size_t i = 0; i < factors; ++i) add(seed.effect(i));
  }
  each_pair(seeds_, [&](int k, int l) {
    const Effects& x = seeds[static_cast<std::size_t>(k)];
    const Effects& y = seeds[static_cast<std::size_t>(l)];
    add((x.a * y.a + x.b * y.b) / 2.0);
    for (std::size_t i = 0; i < factors; ++i) {
      add((first_order(x, y, i) + first_order(y, x, i)) / 2.0);
      add(total(x, y, i));
    }
    if (!rows_.second_order) return;
    for (std::size_t i = 0; i < factors; ++i) {
      for (std::size_t j = i + 1; j < factors; ++j) add(together(x, y, i, j));
    }
  });
  return moments;
}

std::optional<Eigen::VectorXd> SobolMoments::indices(const Eigen::VectorXd& means,
                                                     const Eigen::VectorXd& seed_weights) const {
  const Eigen::Index k_factors = rows_.factors;
  double weights = 0.0, square = 0.0, variance = 0.0;
  Eigen::VectorXd indices = Eigen::VectorXd::Zero(2 * k_factors + factor_pairs());
  Eigen::Index row = static_cast<Eigen::Index>(seeds_) * of_a_seed();
  each_pair(seeds_, [&](int k, int l) {
    const double weight = seeds_ == 1 ? 1.0 : seed_weights[k] * seed_weights[l];
    const Eigen::Index of_k = static_cast<Eigen::Index>(k) * of_a_seed();
    const Eigen::Index of_l = static_cast<Eigen::Index>(l) * of_a_seed();
    const double mean_k = means[of_k], mean_l = means[of_l];
    weights += weight;
    square += weight * means[row];
    variance += weight * (means[row] - mean_k * mean_l);
    ++row;
    for (Eigen::Index i = 0; i < k_factors; ++i) {
      // The mean of (b - mean) (c - a), so that every resample is centred on its own mean.
      const double centre = (mean_k * means[of_l + 1 + i] + mean_l * means[of_k + 1 + i]) / 2.0;
      indices[2 * i] += weight * (means[row] - centre);
      indices[2 * i + 1] += weight * means[row + 1];
      row += 2;
    }
    for (Eigen::Index p = 0; p < factor_pairs(); ++p) {
      indices[2 * k_factors + p] += weight * means[row++];
    }
  });
  if (weights <= 0.0 || variance <= rounding_of_sums * std::abs(square)) return std::nullopt;
  return indices / variance;
}

}  // namespace shoal::analysis
