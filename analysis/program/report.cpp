#include <fmt/core.h>

#include <filesystem>

#include "commands.hpp"
#include "shoal/analysis/reporting/run_report.hpp"
#include "shoal/analysis/reporting/study_report.hpp"
#include "shoal/core/error.hpp"

namespace shoal::program {

void report(const std::string& folder) {
  const std::filesystem::path place = folder;
  if (std::filesystem::exists(place / "study.toml")) {
    analysis::SweptStudy study(place);
    analysis::write_study_report(study);
  } else if (std::filesystem::exists(place / "scenario.toml")) {
    for (const std::string& note : analysis::write_run_report(place)) fmt::print("{}\n", note);
  } else {
    throw InputError(folder +
                     " holds neither a run nor a study; name a folder that shoal run or shoal "
                     "sweep wrote");
  }
  fmt::print("written: {}\n", (place / "report.html").string());
}

}  // namespace shoal::program
