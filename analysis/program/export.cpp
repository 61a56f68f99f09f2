#include "shoal/analysis/reporting/export.hpp"

#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::program {

void export_study(const std::string& folder, const std::string& out) {
  const analysis::StudyExport exported(folder);
  const std::filesystem::path place = out.empty() ? folder : out;
  analysis::require_writable(place);
  write_whole_file(place / "trials.csv", exported.csv());
  exported.write_netcdf(place / "study.nc");
  using State = analysis::StudyResults::State;
  const analysis::StudyResults& results = exported.results();
  fmt::print("written: {}/{{trials.csv,study.nc}}, {} trials, {} failed, {} missing\n",
             place.string(), results.list().trials(), results.count(State::failed),
             results.count(State::missing));
}

}  // namespace shoal::program
