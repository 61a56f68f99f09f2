#include "shoal/analysis/statistics/proportion.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

void require_count(int count, int n) {
  if (n < 1 || count < 0 || count > n) {
    throw std::invalid_argument("a proportion needs a count from 0 to n, and n of at least 1");
  }
}

}  // namespace

Interval clopper_pearson(int count, int n, double level) {
  require_count(count, n);
  if (!(level > 0.0 && level < 1.0)) {
    throw std::invalid_argument("a confidence level is not between 0 and 1");
  }
  const double tail = (1.0 - level) / 2.0;
  const auto quantile_of = [](double a, double b, double p) {
    return quantile(boost::math::beta_distribution<>(a, b), p);
  };
  return {count == 0 ? 0.0 : quantile_of(count, n - count + 1, tail),
          count == n ? 1.0 : quantile_of(count + 1, n - count, 1.0 - tail)};
}

double chance_of_at_least(int count, int n, double p) {
  require_count(count, n);
  if (count == 0) return 1.0;
  return cdf(complement(boost::math::binomial(n, p), count - 1));
}

double chance_of_at_most(int count, int n, double p) {
  require_count(count, n);
  return cdf(boost::math::binomial(n, p), count);
}

}  // namespace shoal::analysis::statistics
