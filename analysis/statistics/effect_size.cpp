#include "shoal/analysis/statistics/effect_size.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace shoal::analysis::statistics {

std::optional<double> cohens_d_z(const Differences& differences) {
  if (!differences.standard_error()) return std::nullopt;
  return mean(differences.values()) / standard_deviation(differences.values());
}

std::optional<double> hedges_g_z(const Differences& differences) {
  const std::optional<double> d_z = cohens_d_z(differences);
  if (!d_z || differences.size() < 3) return std::nullopt;
  const double half = static_cast<double>(differences.size() - 1) / 2.0;
  return *d_z * boost::math::tgamma_ratio(half, half - 0.5) / std::sqrt(half);
}

}  // namespace shoal::analysis::statistics
