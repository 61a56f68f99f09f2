#include "shoal/analysis/statistics/power.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

void require_chance(double p, const char* what) {
  if (!(p > 0.0 && p < 1.0)) throw std::invalid_argument(what);
}

/// Of a standard normal number: the chance to be at most x.
double phi(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// The chance that t, noncentral by `shift`, is above `critical`: the mean over the estimated
/// standard deviation s (Johnson, Kotz and Balakrishnan 1995, sec. 31.4). Unlike the series for its
/// distribution function, the integral is as easy for any shift.
double share_above(double critical, double shift, double degrees) {
  const double half = degrees / 2.0;
  const double density_at_1 = boost::math::gamma_p_derivative(half, half) * degrees;
  const auto integrand = [&](double s) {
    const double density =
        density_at_1 * std::exp((degrees - 1.0) * std::log(s) - half * (s - 1.0) * (s + 1.0));
    return density * phi(shift - critical * s);
  };
  const double width = 12.0 / std::sqrt(2.0 * degrees);
  const double low = std::max(0.0, 1.0 - width), high = 1.0 + width;
  // Around here phi goes from 1 to 0: within 40, where it has less than the least double left.
  const double step = shift / critical, layer = 40.0 / critical;
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  double share = 0.0, begin = low;
  for (const double place : {step - layer, step, step + layer}) {
    const double end = std::clamp(place, low, high);
    if (end > begin) share += Rule::integrate(integrand, begin, end, 4, 1e-12);
    begin = end;
  }
  return std::clamp(share, 0.0, 1.0);
}

/// The fewest of 2 to `most` that suffice, if all more than enough do, too.
template <class Suffice>
std::optional<int> fewest(int most, const Suffice& suffice) {
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

}  // namespace

double paired_t_power(int n, double difference, double sd, double alpha, Alternative alternative) {
  if (n < 2 || !(sd > 0.0) || std::isnan(difference / sd)) {
    throw std::invalid_argument("the power of a t test needs two pairs and an effect");
  }
  require_chance(alpha, "alpha is not between 0 and 1");
  const double degrees = n - 1;
  const boost::math::students_t null(degrees);
  const double shift = difference / sd * std::sqrt(n);
  const bool two_sided = alternative == Alternative::two_sided;
  const double critical = quantile(complement(null, two_sided ? alpha / 2.0 : alpha));
  if (std::isinf(shift)) return two_sided || (shift > 0) == (alternative == Alternative::greater);
  double power = 0.0;
  if (alternative != Alternative::less) power += share_above(critical, shift, degrees);
  if (alternative != Alternative::greater) power += share_above(critical, -shift, degrees);
  return std::min(power, 1.0);
}

double two_sided_power(const PairedTest& test, int n, double effect, double alpha) {
  require_chance(alpha, "alpha is not between 0 and 1");
  return test.power(n, effect, alpha);
}

std::optional<int> replications_for(const PairedTest& test, double effect, double alpha,
                                    double power, int most) {
  require_chance(power, "a power is not between 0 and 1");
  const auto suffice = [&](int n) { return two_sided_power(test, n, effect, alpha) >= power; };
  const auto by_t = replications_for(effect, 1.0, alpha, power, most);
  if (!by_t) return by_t;
  // No test of normal differences has more power than Student's: the search begins there.
  int n = *by_t;
  while (n <= most && test.least_p_value(n) > alpha) ++n;
  if (n > most) return std::nullopt;
  if (suffice(n)) return n;
  const auto more = fewest(most - n + 1, [&](int extra) { return suffice(n + extra - 1); });
  return more ? std::optional(n + *more - 1) : std::nullopt;
}

std::optional<int> replications_for(double difference, double sd, double alpha, double power,
                                    int most) {
  require_chance(power, "a power is not between 0 and 1");
  return fewest(most, [&](int n) { return paired_t_power(n, difference, sd, alpha) >= power; });
}

}  // namespace shoal::analysis::statistics
