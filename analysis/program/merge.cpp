#include "shoal/analysis/experiments/store/merge.hpp"

#include <fmt/core.h>

#include "commands.hpp"

namespace shoal::program {

void merge(const std::string& folder, const std::vector<std::string>& others) {
  const analysis::Merged merged = analysis::merge(folder, {others.begin(), others.end()});
  for (const analysis::MergedFolder& each : merged.folders) {
    if (each.folder == folder && each.trials + each.others == 0) continue;  // it is new
    std::string line = fmt::format("{}: {} trials", each.folder.string(), each.trials);
    if (each.taken < each.trials) {
      line += fmt::format(", {} of them in a folder before it, too", each.trials - each.taken);
    }
    if (each.others > 0) {
      line += fmt::format("; {} more, which the study does not ask for, stay there", each.others);
    }
    fmt::print("{}\n", line);
  }
  const std::size_t missing = merged.list.trials() - merged.stored;
  fmt::print("{}: {} of {} trials are stored, {} failed, {} are missing\n", folder, merged.stored,
             merged.list.trials(), merged.failed, missing);
  // A part of a study has no tables of its own.
  if (missing == 0) return tables(folder, true);
  fmt::print("shoal sweep {0}/study.toml --out {0} runs them\n", folder);
}

}  // namespace shoal::program
