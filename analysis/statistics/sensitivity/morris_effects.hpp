#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/statistics/sensitivity/bootstrap.hpp"

namespace shoal::analysis {

/// The elementary effects of one factor: what the answer changes by, in its unit, for a change of
/// the factor by its whole range.
struct MorrisEffect {
  double mu = 0.0;              ///< their mean (Morris 1991)
  IndexEstimate mu_star;        ///< the mean of their sizes (Campolongo, Cariboni, Saltelli 2007)
  std::optional<double> sigma;  ///< the sample's standard deviation, large where the factor acts in
                                ///< a curve or with others; nothing for one trajectory
};

/// Elementary effects of all factors, in the order of the factors.
struct MorrisEffects {
  int trajectories = 0;               ///< that count
  int left_out = 0;                   ///< trajectories of which some answer is missing
  std::vector<MorrisEffect> factors;  ///< empty where effects are not defined
  std::string undefined;              ///< why they are not; "" if they are
};

/// Elementary effects from the answers to a design `morris`. `cells` is that design, cells x
/// factors.
///
/// A trajectory of which any answer is missing is left out as a whole and counted, so that all
/// factors are judged at the same places. Not defined if no trajectory is left.
///
/// Throws std::invalid_argument if there is not one answer for each cell, if an answer is not
/// finite, or if the cells are not trajectories along which every factor changes once.
MorrisEffects morris_effects(const Eigen::MatrixXd& cells, Answers answers,
                             const Resampling& resampling = {});

}  // namespace shoal::analysis
