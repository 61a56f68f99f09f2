#include "shoal/formations/behaviour.hpp"

#include <array>

namespace shoal::formations {

std::string_view name_of(Reason reason) {
  static constexpr std::array<std::string_view, reason_count> names{
      "placed", "no_neighbour", "one_neighbour", "degenerate", "solver_failed"};
  return names[static_cast<std::size_t>(reason)];
}

}  // namespace shoal::formations
