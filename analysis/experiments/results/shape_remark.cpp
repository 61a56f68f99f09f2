#include "shoal/analysis/experiments/results/shape_remark.hpp"

#include <fmt/format.h>

#include "shoal/analysis/statistics/shape.hpp"

namespace shoal::analysis {
namespace {

constexpr double shape_level = 0.01;
constexpr double apart =
    0.9;  // of a normal sample, two groups explain 0.64; of a uniform one, 0.75

std::string groups_text(const statistics::TwoGroups& groups) {
  const int n = groups.low_n + groups.high_n;
  return fmt::format("{} of {} at {:.3g}, {} of {} at {:.3g}", groups.low_n, n, groups.low_mean,
                     groups.high_n, n, groups.high_mean);
}

}  // namespace

std::optional<std::string> remark_on_shape(const std::vector<double>& values) {
  const std::optional<double> of_dip = statistics::dip_p_value(values);
  const std::optional<double> of_skewness = statistics::skewness_p_value(values);
  const bool two_modes = of_dip && *of_dip <= shape_level;
  const bool skewed = of_skewness && *of_skewness <= shape_level;
  if (!two_modes && !skewed) return std::nullopt;
  const std::optional<statistics::TwoGroups> groups = statistics::two_groups(values);
  if (!groups) return std::nullopt;
  if (groups->explained >= apart) return "Two kinds: " + groups_text(*groups) + ".";
  if (two_modes) return "Two modes: " + groups_text(*groups) + ".";
  return fmt::format("Skewed ({:+.2f}).", *statistics::skewness(values));
}

std::string note_on_shapes() {
  return "Marked as of two modes: Hartigan's dip test rejects one mode at 1 %; as skewed: its "
         "skewness is that of a normal sample with a chance below 1 %; as of two kinds: either, "
         "and "
         "two groups explain 90 % of the variance. Their shares and means are those of the best "
         "split.";
}

}  // namespace shoal::analysis
