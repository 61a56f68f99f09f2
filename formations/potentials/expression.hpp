#pragma once

#include <optional>
#include <string>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// A potential of your own, written as text: in a scenario, a study, `--set` or a program.
struct Expression {
  std::string formula = "s^3/(2*r^2) + r - 3*s";  // Rypkema 2015, eq. 3.3
  NamedNumbers parameters = {};
  double from_m = 0.1;
  double to_m = 10'000.0;

  std::optional<std::string> complaint() const;
  static void declare(Options<Expression>& o);
};

}  // namespace shoal::formations
