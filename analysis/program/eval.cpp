#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/analysis/experiments/evaluation.hpp"

namespace shoal::program {

void eval(const std::string& model, const std::string& file) {
  fmt::print("{}", analysis::evaluated(model, file));
}

}  // namespace shoal::program
