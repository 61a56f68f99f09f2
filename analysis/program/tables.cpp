#include <fmt/core.h>

#include <filesystem>
#include <map>

#include "commands.hpp"
#include "shoal/analysis/study/study_files.hpp"
#include "shoal/analysis/study/study_tables.hpp"

namespace shoal::program {
namespace {

using analysis::JudgedClaim;
using analysis::StudyResults;
using analysis::Verdict;

void print_state(const StudyResults& results) {
  const std::size_t failed = results.count(StudyResults::State::failed);
  const std::size_t missing = results.count(StudyResults::State::missing);
  if (failed > 0) fmt::print("{} trials failed; they are missing from the numbers\n", failed);
  if (missing > 0) fmt::print("{} trials have not run yet; shoal sweep runs them\n", missing);
}

std::string count_text(const std::vector<JudgedClaim>& claims) {
  std::map<Verdict, int> counts;
  for (const JudgedClaim& claim : claims) ++counts[claim.result.verdict];
  return fmt::format("{} claims: {} reproduced, {} contradicted, {} undecided", claims.size(),
                     counts[Verdict::reproduced], counts[Verdict::contradicted],
                     counts[Verdict::undecided]);
}

void write_all(const StudyResults& results, const std::vector<analysis::Table>& tables,
               const std::vector<JudgedClaim>& claims, const std::string& folder) {
  const std::size_t written = analysis::write_tables(tables, claims, folder);
  print_state(results);
  fmt::print("written: {}/tables, {} tables as .tex, .csv and .md\n", folder, written);
  if (!claims.empty()) fmt::print("{} (shoal claims {})\n", count_text(claims), folder);
}

}  // namespace

void tables(const std::string& folder, bool summary) {
  const StudyResults results = analysis::read_results(analysis::stored_plan(folder), folder);
  const std::vector<analysis::Table> tables = analysis::study_tables(results);
  const std::vector<JudgedClaim> claims = analysis::judged_claims(results);
  // After a sweep, the first table: the one that the study begins with.
  const std::size_t shown = summary ? std::min<std::size_t>(1, tables.size()) : tables.size();
  for (std::size_t i = 0; i < shown; ++i) {
    fmt::print("{}:\n{}\n", tables[i].name,
               analysis::print(tables[i], analysis::TableFormat::text));
  }
  write_all(results, tables, claims, folder);
}

void claims(const std::string& folder) {
  const StudyResults results = analysis::read_results(analysis::stored_plan(folder), folder);
  const std::vector<JudgedClaim> judged = analysis::judged_claims(results);
  if (judged.empty()) {
    throw InputError(folder +
                     ": the study has no claims; name a file of them with claims = \"...\"");
  }
  for (const JudgedClaim& each : judged) {
    fmt::print("{:<13} {}  {}\n", name_of(each.result.verdict), each.claim.section,
               each.claim.says);
    for (const analysis::ContrastResult& contrast : each.result.contrasts) {
      fmt::print("{:14}{}\n", "", analysis::contrast_text(contrast));
    }
    if (each.result.replications_needed) {
      fmt::print("{:14}about {} replications would decide\n", "", *each.result.replications_needed);
    }
    if (each.result.verdict == Verdict::contradicted && !each.claim.cause.empty()) {
      fmt::print("{:14}likely cause: {}\n", "", each.claim.cause);
    }
  }
  print_state(results);
  fmt::print("{}\n", count_text(judged));
}

}  // namespace shoal::program
