#include "shoal/analysis/statistics/sensitivity/shapley.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {
namespace {

using Eigen::Index;

/// Of a coalition of `size` players that another one joins: the share of the orders of `players` in
/// which these come first, and then that one. It is size! (players - size - 1)! / players!.
std::vector<double> weights_by_size(int players) {
  std::vector<double> weights{1.0 / players};
  for (int size = 1; size < players; ++size) {
    weights.push_back(weights.back() * size / (players - size));
  }
  return weights;
}

std::size_t cells_of(Answers answers, int factors) {
  if (factors < 1 || factors > 20) {
    throw std::invalid_argument("an attribution takes 1 to 20 factors");
  }
  const std::size_t cells = std::size_t{1} << factors;
  if (answers.size() % cells != 0) {
    throw std::invalid_argument("the answers are not those of whole factorial designs");
  }
  require_finite(answers);
  return cells;
}

/// The mean over seeds, with Student's interval.
IndexEstimate estimate(const Eigen::RowVectorXd& of_seeds, double level) {
  const statistics::Sample sample(of_seeds.data(), static_cast<std::size_t>(of_seeds.size()));
  return {.value = of_seeds.mean(), .interval = statistics::t_interval(sample, level)};
}

}  // namespace

Eigen::VectorXd shapley_values(const Eigen::VectorXd& worths) {
  const auto coalitions = static_cast<std::size_t>(worths.size());
  if (!std::has_single_bit(coalitions)) {
    throw std::invalid_argument("the number of coalitions is no power of two");
  }
  const int players = std::countr_zero(coalitions);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(players);
  if (players == 0) return values;
  const std::vector<double> weights = weights_by_size(players);
  for (std::size_t without = 0; without < coalitions; ++without) {
    for (int player = 0; player < players; ++player) {
      const std::size_t with = without | (std::size_t{1} << player);
      if (with == without) continue;
      values[player] += weights[static_cast<std::size_t>(std::popcount(without))] *
                        (worths[static_cast<Index>(with)] - worths[static_cast<Index>(without)]);
    }
  }
  return values;
}

ShapleyAttribution shapley_attribution(Answers answers, int factors, double level) {
  const std::size_t cells = cells_of(answers, factors);
  const auto all = static_cast<Index>(cells - 1);
  ShapleyAttribution result;
  Eigen::MatrixXd worths(cells, answers.size() / cells);  // a column a seed
  for (std::size_t first = 0; first < answers.size(); first += cells) {
    const Answers seed = answers.subspan(first, cells);
    if (!std::ranges::all_of(seed, [](const auto& y) { return y.has_value(); })) {
      ++result.left_out;
      continue;
    }
    for (std::size_t cell = 0; cell < cells; ++cell) {
      worths(static_cast<Index>(cell), result.seeds) = *seed[cell];
    }
    ++result.seeds;
  }
  if (result.seeds == 0) {
    result.undefined = "no seed has all its answers";
    return result;
  }
  worths.conservativeResize(Eigen::NoChange, result.seeds);
  Eigen::MatrixXd shares(factors, result.seeds);
  for (Index k = 0; k < worths.cols(); ++k) shares.col(k) = shapley_values(worths.col(k));

  result.before = estimate(worths.row(0), level);
  result.after = estimate(worths.row(all), level);
  result.together = estimate(worths.row(all) - worths.row(0), level);
  for (int f = 0; f < factors; ++f) {
    const Index own = Index{1} << f;
    result.factors.push_back({.share = estimate(shares.row(f), level),
                              .alone = estimate(worths.row(own) - worths.row(0), level),
                              .last = estimate(worths.row(all) - worths.row(all - own), level)});
  }
  return result;
}

}  // namespace shoal::analysis
