// The trials of a sweep, as `shoal tables` reads them.

#include "fuzzed.hpp"
#include "shoal/analysis/experiments/store/store.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto file = tests::fuzzed_file("trials.sqlite", input);
  try {
    const analysis::Store store(file.parent_path(), analysis::Store::Access::read);
    for (const auto& trial : store.trials()) store.series_of(trial.key);
    for (const auto& name : store.series_names()) store.series(name);
  } catch (const SystemError& error) {  // SQLite says what is wrong with a damaged file
    throw InputError(error.what());
  }
}
