#include "shoal/analysis/statistics/paired_spread.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace shoal::analysis::statistics {
namespace {

/// The sample's standard deviations and correlation.
struct Moments {
  double ours, theirs, correlation;
};

std::optional<Moments> moments(Sample ours, Sample theirs) {
  if (ours.size() != theirs.size()) throw std::invalid_argument("numbers are not in pairs");
  if (!standard_error(ours) || !standard_error(theirs)) return std::nullopt;
  const double a = mean(ours), b = mean(theirs);
  double sum = 0.0;
  for (std::size_t k = 0; k < ours.size(); ++k) sum += (ours[k] - a) * (theirs[k] - b);
  const double sa = standard_deviation(ours), sb = standard_deviation(theirs);
  const double correlation = sum / (static_cast<double>(ours.size()) - 1.0) / (sa * sb);
  return Moments{sa, sb, std::clamp(correlation, -1.0, 1.0)};
}

}  // namespace

std::optional<double> spread_ratio(Sample ours, Sample theirs) {
  const auto m = moments(ours, theirs);
  return m ? std::optional(m->ours / m->theirs) : std::nullopt;
}

std::optional<TestResult> spread_test(Sample ours, Sample theirs, Alternative alternative) {
  const auto m = moments(ours, theirs);
  if (!m || ours.size() < 3) return std::nullopt;
  // The correlation r of sums and differences, as t = r sqrt((n - 2) / (1 - r^2)).
  const double degrees = static_cast<double>(ours.size()) - 2.0;
  const double apart = (m->ours - m->theirs) * (m->ours + m->theirs);
  const double rest =
      2.0 * m->ours * m->theirs * std::sqrt((1.0 - m->correlation) * (1.0 + m->correlation));
  const boost::math::students_t null(degrees);
  const double infinite = std::numeric_limits<double>::infinity();
  const double t = rest > 0.0    ? apart * std::sqrt(degrees) / rest
                   : apart > 0.0 ? infinite
                   : apart < 0.0 ? -infinite
                                 : 0.0;
  const auto above = [&](double x) {
    if (std::isinf(x)) return x > 0.0 ? 0.0 : 1.0;
    return cdf(complement(null, x));
  };
  const double p = alternative == Alternative::greater ? above(t)
                   : alternative == Alternative::less  ? above(-t)
                                                       : 2.0 * above(std::abs(t));
  return TestResult{t, p, static_cast<int>(ours.size()), true};
}

std::optional<Interval> spread_ratio_interval(Sample ours, Sample theirs, double level) {
  if (!(level > 0.0 && level < 1.0)) {
    throw std::invalid_argument("a confidence level is not between 0 and 1");
  }
  const auto m = moments(ours, theirs);
  if (!m || ours.size() < 3) return std::nullopt;
  const double degrees = static_cast<double>(ours.size()) - 2.0;
  const double t = quantile(boost::math::students_t(degrees), (1.0 + level) / 2.0);
  const double k = 1.0 + 2.0 * (1.0 - m->correlation * m->correlation) * t * t / degrees;
  const double root = std::sqrt((k - 1.0) * (k + 1.0));
  const double ratio = m->ours / m->theirs;
  // (k - root)(k + root) = 1.
  return Interval{ratio / std::sqrt(k + root), ratio * std::sqrt(k + root)};
}

}  // namespace shoal::analysis::statistics
