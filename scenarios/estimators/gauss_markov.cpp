#include "shoal/scenarios/estimators/gauss_markov.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <string>

#include "shoal/core/error.hpp"

namespace shoal::scenarios {
namespace {

Grade mirrored(const Grade& grade) {
  return {-grade.mean, grade.sd, grade.rate};
}

}  // namespace

GaussMarkov::GaussMarkov(const Grade& nominal, const Grade& reliable, const Grade& unreliable,
                         const Matrix& transition)
    : grades_{nominal, reliable, mirrored(reliable), unreliable, mirrored(unreliable)},
      transition_(transition) {
  for (int i = 0; i < 6; ++i) {
    const double sum = transition_.row(i).sum();
    if (!(std::abs(sum - 1.0) <= 1e-3) || !(transition_.row(i).minCoeff() >= 0.0)) {
      throw InputError("row " + std::to_string(i) +
                       " of a transition matrix has to hold probabilities that add up to 1, not " +
                       std::to_string(sum));
    }
    transition_.row(i) /= sum;
  }
}

GaussMarkov GaussMarkov::without_faults() const {
  GaussMarkov sound = *this;
  sound.transition_.col(fault).setZero();
  for (int i = 0; i < 6; ++i) sound.transition_.row(i) /= sound.transition_.row(i).sum();
  return sound;
}

GaussMarkov::Shares GaussMarkov::stationary() const {
  // pi (T - 1) = 0 and sum(pi) = 1; one of the six balances follows from the others.
  Matrix balance = transition_.transpose() - Matrix::Identity();
  balance.row(0).setOnes();
  return balance.partialPivLu().solve(Shares::Unit(0));
}

double GaussMarkov::next(Channel& channel, double uniform, double normal, double steps) const {
  const auto row = transition_.row(channel.state);
  int state = 0;
  for (double passed = row(0); state < fault && uniform >= passed; passed += row(state)) ++state;
  // Rounding may leave the sum of a row below the largest uniform: then the last state that can be
  // reached at all holds.
  while (row(state) == 0.0) --state;
  channel.state = state;
  if (state == fault) {
    channel.value = 0.0;
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Grade& grade = grades_[static_cast<std::size_t>(state)];
  channel.value = rate_limited(channel.value, grade.mean + grade.sd * normal, grade.rate * steps);
  return channel.value;
}

}  // namespace shoal::scenarios
