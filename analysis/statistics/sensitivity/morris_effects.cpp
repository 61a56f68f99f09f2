#include "shoal/analysis/statistics/sensitivity/morris_effects.hpp"

#include <algorithm>
#include <stdexcept>

namespace shoal::analysis {
namespace {

/// The effect of each factor along one trajectory of k + 1 cells.
Eigen::VectorXd effects_along(const Eigen::MatrixXd& cells, Answers answers) {
  const Eigen::Index k = cells.cols();
  Eigen::VectorXd effects(k);
  std::vector<bool> changed(static_cast<std::size_t>(k), false);
  for (Eigen::Index step = 0; step < k; ++step) {
    const Eigen::RowVectorXd change = cells.row(step + 1) - cells.row(step);
    Eigen::Index f = 0;
    change.cwiseAbs().maxCoeff(&f);
    if ((change.array() != 0.0).count() != 1 || changed[static_cast<std::size_t>(f)]) {
      throw std::invalid_argument("the cells are no trajectories that change each factor once");
    }
    changed[static_cast<std::size_t>(f)] = true;
    const auto i = static_cast<std::size_t>(step);
    effects[f] = (*answers[i + 1] - *answers[i]) / change[f];
  }
  return effects;
}

/// The sample's; nothing for one value.
std::optional<double> deviation(const Eigen::VectorXd& values) {
  if (values.size() < 2) return std::nullopt;
  return statistics::standard_deviation({values.data(), static_cast<std::size_t>(values.size())});
}

}  // namespace

MorrisEffects morris_effects(const Eigen::MatrixXd& cells, Answers answers,
                             const Resampling& resampling) {
  const Eigen::Index rows = cells.cols() + 1;
  if (cells.cols() < 1 || cells.rows() % rows != 0 ||
      static_cast<std::size_t>(cells.rows()) != answers.size()) {
    throw std::invalid_argument("the answers are not those of whole trajectories");
  }
  require_finite(answers);

  MorrisEffects result;
  Eigen::MatrixXd effects(cells.cols(), cells.rows() / rows);
  for (Eigen::Index t = 0; t < effects.cols(); ++t) {
    const Answers along =
        answers.subspan(static_cast<std::size_t>(t * rows), static_cast<std::size_t>(rows));
    if (!std::ranges::all_of(along, [](const auto& y) { return y.has_value(); })) {
      ++result.left_out;
      continue;
    }
    effects.col(result.trajectories) = effects_along(cells.middleRows(t * rows, rows), along);
    ++result.trajectories;
  }
  if (result.trajectories == 0) {
    result.undefined = "no trajectory has all its answers";
    return result;
  }
  const Eigen::MatrixXd complete = effects.leftCols(result.trajectories);
  const std::vector<IndexEstimate> sizes = bootstrap(
      complete.cwiseAbs(), [](const Eigen::VectorXd& means) { return means; }, resampling);
  for (Eigen::Index f = 0; f < complete.rows(); ++f) {
    result.factors.push_back({.mu = complete.row(f).mean(),
                              .mu_star = sizes[static_cast<std::size_t>(f)],
                              .sigma = deviation(complete.row(f))});
  }
  return result;
}

}  // namespace shoal::analysis
