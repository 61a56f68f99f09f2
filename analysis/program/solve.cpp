#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/analysis/benchmarking/solver_comparison.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {

void solve(const SolveArguments& arguments) {
  const auto format = analysis::table_format(arguments.format);
  analysis::ComparisonSettings settings{.solvers = arguments.solvers,
                                        .reference = arguments.reference,
                                        .options = {},
                                        .progress = !arguments.profiles.empty()};
  for (const std::string& set : arguments.sets) scenarios::apply_set(settings.options, set);
  analysis::SolverComparison comparison(settings);
  const analysis::Corpus corpus = analysis::read_corpus(arguments.corpus);
  const std::filesystem::path profiles = arguments.profiles;
  std::filesystem::path progress = profiles;
  progress.replace_filename(profiles.stem().string() + "_progress" + profiles.extension().string());
  if (!profiles.empty()) {
    for (const auto& file : {profiles, progress}) analysis::require_writable_file(file);
  }
  comparison.run(corpus);
  if (comparison.families().empty()) {
    throw InputError("no problem of " + arguments.corpus +
                     " belongs to the family of a solver that was named");
  }
  fmt::print("{}", format->print(analysis::comparison_table(comparison, arguments.same_within_m)));
  if (profiles.empty()) return;
  const auto write = [](const std::filesystem::path& file, const analysis::Table& table) {
    write_whole_file(file, as_csv(table));
  };
  write(profiles, analysis::performance_profiles(comparison));
  write(progress, analysis::progress_curves(comparison));
}

}  // namespace shoal::program
