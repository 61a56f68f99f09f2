#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/analysis/benchmarking/solver_comparison.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {

void solve(const SolveArguments& arguments) {
  const analysis::TableFormat format = analysis::table_format(arguments.format);
  analysis::ComparisonSettings settings{
      .solvers = arguments.solvers, .reference = arguments.reference, .options = {}};
  for (const std::string& set : arguments.sets) scenarios::apply_set(settings.options, set);
  analysis::SolverComparison comparison(settings);
  const analysis::Corpus corpus = analysis::read_corpus(arguments.corpus);
  if (!arguments.profiles.empty()) analysis::require_writable_file(arguments.profiles);
  comparison.run(corpus);
  if (comparison.families().empty()) {
    throw InputError("no problem of " + arguments.corpus +
                     " belongs to the family of a solver that was named");
  }
  fmt::print("{}", print(analysis::comparison_table(comparison, arguments.same_within_m), format));
  if (!arguments.profiles.empty()) {
    write_whole_file(arguments.profiles,
                     print(analysis::performance_profiles(comparison), analysis::TableFormat::csv));
  }
}

}  // namespace shoal::program
