#include "shoal/analysis/statistics/variation.hpp"

#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

/// The chance of a statistic of at least t, and of at most t, if its noncentrality is `delta`.
double at_least(double t, double degrees, double delta) {
  if (delta == 0.0) return cdf(complement(boost::math::students_t(degrees), t));
  return cdf(complement(boost::math::non_central_t(degrees, delta), t));
}

double at_most(double t, double degrees, double delta) {
  if (delta == 0.0) return cdf(boost::math::students_t(degrees), t);
  return cdf(boost::math::non_central_t(degrees, delta), t);
}

/// sqrt(n) mean / sd, with the sign of the mean left out.
std::optional<double> statistic_of(Sample values) {
  const std::optional<double> error = standard_error(values);
  if (!error || mean(values) == 0.0) return std::nullopt;
  return std::abs(mean(values)) / *error;
}

/// Where a function that falls from above `target` crosses it, from 0 on.
template <class Falling>
double crossing(Falling falling, double target, double first_step) {
  double low = 0.0, high = first_step;
  while (falling(high) > target) {
    low = high;
    high *= 2.0;
  }
  for (int step = 0; step < 100 && high - low > 1e-12 * high; ++step) {
    const double middle = (low + high) / 2.0;
    (falling(middle) > target ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

}  // namespace

std::optional<double> variation(Sample values) {
  const auto t = statistic_of(values);
  return t ? std::optional(std::sqrt(static_cast<double>(values.size())) / *t) : std::nullopt;
}

std::optional<VariationTest> variation_test(Sample values, double bound) {
  if (!(bound > 0.0)) throw std::invalid_argument("a bound of variation is not above 0");
  const auto t = statistic_of(values);
  if (!t) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  const double delta = std::sqrt(n) / bound;
  return VariationTest{at_least(*t, n - 1.0, delta), at_most(*t, n - 1.0, delta)};
}

std::optional<Interval> variation_interval(Sample values, double level) {
  if (!(level > 0.0 && level < 1.0)) {
    throw std::invalid_argument("a confidence level is not between 0 and 1");
  }
  const auto t = statistic_of(values);
  if (!t) return std::nullopt;
  const double tail = (1.0 - level) / 2.0;
  const auto n = static_cast<double>(values.size());
  // A large noncentrality makes a statistic of at most t unlikely, a small one of at least t.
  const double high =
      crossing([&](double delta) { return at_most(*t, n - 1.0, delta); }, tail, *t + 1.0);
  const bool bounded = at_least(*t, n - 1.0, 0.0) < tail;
  const double low =
      bounded ? crossing([&](double delta) { return 1.0 - at_least(*t, n - 1.0, delta); },
                         1.0 - tail, *t + 1.0)
              : 0.0;
  return Interval{std::sqrt(n) / high,
                  bounded ? std::sqrt(n) / low : std::numeric_limits<double>::infinity()};
}

}  // namespace shoal::analysis::statistics
