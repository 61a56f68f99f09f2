// A formula of a potential.

#include "fuzzed.hpp"
#include "shoal/formations/formula.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  formations::Formula formula(input);
  formula.derivatives(10.0, 100.0);
  formula.prepare(100.0);
  formula.derivatives(10.0, 100.0);
  if (const auto said = formula.trouble(1.0, 1000.0, 100.0)) throw InputError(*said);
}
