#include "shoal/analysis/statistics/power.hpp"

#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

bool is_chance(double p) {
  return p > 0.0 && p < 1.0;
}

}  // namespace

double paired_t_power(int n, double difference, double sd, double alpha, Alternative alternative) {
  if (n < 2 || !(sd > 0.0) || !std::isfinite(difference / sd)) {
    throw std::invalid_argument("the power of a t test needs two pairs and a finite effect");
  }
  if (!is_chance(alpha)) throw std::invalid_argument("alpha is not between 0 and 1");

  const double degrees = n - 1;
  const boost::math::students_t null(degrees);
  const boost::math::non_central_t t(degrees, difference / sd * std::sqrt(n));
  const bool two_sided = alternative == Alternative::two_sided;
  const double critical = quantile(complement(null, two_sided ? alpha / 2.0 : alpha));
  double power = 0.0;
  if (alternative != Alternative::less) power += cdf(complement(t, critical));
  if (alternative != Alternative::greater) power += cdf(t, -critical);
  return power;
}

std::optional<int> replications_for(double difference, double sd, double alpha, double power,
                                    int most) {
  if (!is_chance(power)) throw std::invalid_argument("a power is not between 0 and 1");
  const auto suffice = [&](int n) { return paired_t_power(n, difference, sd, alpha) >= power; };

  // Doubling first keeps the noncentrality small, where its distribution is cheap and accurate.
  int too_few = 1, enough = 2;
  while (enough <= most && !suffice(enough)) {
    if (enough == most) return std::nullopt;
    too_few = enough;
    enough = enough > most / 2 ? most : 2 * enough;
  }
  if (enough > most) return std::nullopt;
  while (enough - too_few > 1) {
    const int middle = too_few + (enough - too_few) / 2;
    (suffice(middle) ? enough : too_few) = middle;
  }
  return enough;
}

}  // namespace shoal::analysis::statistics
