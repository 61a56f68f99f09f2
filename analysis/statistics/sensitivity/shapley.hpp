#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/statistics/sensitivity/bootstrap.hpp"

namespace shoal::analysis {

/// What one of several changes does to an answer, in its unit.
struct ShapleyFactor {
  IndexEstimate share;  ///< the mean over all orders in which the changes can be made
  IndexEstimate alone;  ///< as the only change
  IndexEstimate last;   ///< when all others have been made
};

/// How far each of several changes accounts for the difference that they make together.
struct ShapleyAttribution {
  int seeds = 0;                       ///< that count
  int left_out = 0;                    ///< seeds of which some answer is missing
  IndexEstimate before;                ///< nothing is changed
  IndexEstimate after;                 ///< everything is
  IndexEstimate together;              ///< after - before; the sum of the shares
  std::vector<ShapleyFactor> factors;  ///< empty where there is no seed left
  std::string undefined;               ///< why there are none; "" if there are
};

/// The Shapley value of every player (Shapley 1953, A value for n-person games): its marginal
/// contribution, averaged over all orders in which the players may come. `worths` has one number
/// for each of 2^n coalitions: bit i of its place says whether player i takes part. O(n 2^n).
///
/// The values add up to the worth of all minus that of none. A player that never changes the worth
/// gets 0, two that change it alike get the same, and of a sum of games each gets the sum.
///
/// Throws std::invalid_argument unless the number of worths is a power of two.
Eigen::VectorXd shapley_values(const Eigen::VectorXd& worths);

/// Attributes the difference between a full factorial design's two extreme cells to its factors.
/// `answers` has one block a seed, and in each the 2^factors cells in the order of `worths` above.
///
/// Values are means over seeds; as each is linear in the answers, that of the means is the mean of
/// those of the seeds, whose scatter gives Student's intervals at `level`: all cells share their
/// seeds. A seed of which any answer is missing is left out as a whole and counted.
///
/// Throws std::invalid_argument if `answers` are no multiple of 2^factors, or not finite.
ShapleyAttribution shapley_attribution(Answers answers, int factors, double level = 0.95);

}  // namespace shoal::analysis
