// The tests that rest on Student's t distribution.

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>

#include "shoal/analysis/statistics/equivalence.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {

std::optional<TestResult> paired_t_test(const Differences& differences, Alternative alternative) {
  const std::optional<double> error = differences.standard_error();
  if (!error) return std::nullopt;
  const double t = mean(differences.values()) / *error;
  const boost::math::students_t null(static_cast<double>(differences.size() - 1));
  const auto p_value = [&] {
    if (alternative == Alternative::greater) return cdf(complement(null, t));
    if (alternative == Alternative::less) return cdf(null, t);
    return 2.0 * cdf(complement(null, std::abs(t)));
  };
  return TestResult{t, p_value(), static_cast<int>(differences.size()), true};
}

std::optional<double> equivalence_p_value(const Differences& differences, double margin) {
  if (!(margin > 0.0 && std::isfinite(margin))) {
    throw std::invalid_argument("a margin of equivalence is not above 0");
  }
  const std::optional<double> error = differences.standard_error();
  if (!error) return std::nullopt;
  // The larger of the two p-values belongs to the end of the margin that is nearer.
  const boost::math::students_t null(static_cast<double>(differences.size() - 1));
  return cdf(null, (std::abs(mean(differences.values())) - margin) / *error);
}

}  // namespace shoal::analysis::statistics
