#include "shoal/analysis/statistics/designs/drawn.hpp"

#include <bit>
#include <boost/random/sobol.hpp>

#include "shoal/analysis/statistics/design.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis {
void require_drawable(std::span<const int> levels, double cells, const Origin& origin) {
  if (levels.empty()) {
    throw InputError(origin, "a design that draws its cells needs a factor; add [[factor]]");
  }
  if (cells > most_cells) {
    throw InputError(origin, "the design has more than 10 million cells; draw fewer");
  }
}

std::optional<std::string> power_of_two_complaint(const std::string& option, std::int64_t n) {
  const auto count = static_cast<std::uint64_t>(n);
  if (std::has_single_bit(count)) return std::nullopt;
  return option + " = " + std::to_string(n) +
         " is not a power of two, which the balance of Sobol' sequence needs; give " +
         std::to_string(std::bit_floor(count)) + " or " + std::to_string(std::bit_ceil(count));
}

Eigen::MatrixXd sobol_points(Eigen::Index points, Eigen::Index dimensions, std::uint64_t seed,
                             const Origin& origin) {
  constexpr auto most = boost::random::default_sobol_table::max_dimension;
  if (static_cast<std::size_t>(dimensions) > most) {
    throw InputError(origin, "Sobol' sequence is known for " + std::to_string(most) +
                                 " dimensions and would need " + std::to_string(dimensions) +
                                 "; vary fewer factors");
  }
  // Points are kept as 53 binary digits, so that every coordinate is exact and below one.
  std::vector<std::uint64_t> shift;
  const RandomStreams random(seed);
  for (Eigen::Index d = 0; d < dimensions; ++d) {
    const double u = random.uniform(Purpose::design, static_cast<std::uint32_t>(d), 0)[0];
    shift.push_back(static_cast<std::uint64_t>(u * 0x1p53));
  }
  boost::random::sobol sequence(static_cast<std::size_t>(dimensions));
  Eigen::MatrixXd drawn(points, dimensions);
  for (Eigen::Index i = 0; i < points; ++i) {
    for (Eigen::Index d = 0; d < dimensions; ++d) {
      // Boost leaves the origin out; without it the first 2^m points are no net.
      const std::uint64_t digits = i == 0 ? 0 : sequence() >> 11;
      drawn(i, d) = static_cast<double>(digits ^ shift[static_cast<std::size_t>(d)]) * 0x1p-53;
    }
  }
  return drawn;
}

}  // namespace shoal::analysis
