#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"

namespace shoal::analysis {

/// The numbers whose means over base samples Sobol' indices are made of: some of each seed, and
/// some of each pair of seeds (of the one seed with itself, if there is only one).
class SobolMoments {
 public:
  SobolMoments(SaltelliRows rows, int seeds) : rows_(rows), seeds_(seeds) {}

  /// Numbers x base samples. `answers` has a matrix for each seed, rows of the design (A, AB_i,
  /// BA_i, B) x base samples.
  Eigen::MatrixXd of(const std::vector<Eigen::MatrixXd>& answers) const;

  /// First-order and total index of each factor in turn, then those of pairs, from the means of
  /// `of` and from how often each seed counts. Nothing where there is no variance.
  std::optional<Eigen::VectorXd> indices(const Eigen::VectorXd& means,
                                         const Eigen::VectorXd& seed_weights) const;

 private:
  int factor_pairs() const {
    return rows_.second_order ? rows_.factors * (rows_.factors - 1) / 2 : 0;
  }
  int of_a_seed() const { return 1 + rows_.factors; }
  int of_a_pair() const { return 1 + 2 * rows_.factors + factor_pairs(); }

  SaltelliRows rows_;
  int seeds_;
};

}  // namespace shoal::analysis
