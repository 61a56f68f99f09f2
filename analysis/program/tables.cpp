#include <fmt/core.h>

#include <algorithm>

#include "commands.hpp"
#include "shoal/analysis/experiments/claims/claim_text.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/tables/latex_signs.hpp"
#include "shoal/core/text.hpp"
#include "show_tables.hpp"

namespace shoal::program {
namespace {

using analysis::Judgement;
using analysis::StudyResults;
using analysis::SweptStudy;

void print_state(const StudyResults& results) {
  const std::size_t failed = results.count(StudyResults::State::failed);
  const std::size_t missing = results.count(StudyResults::State::missing);
  if (failed > 0) fmt::print("{} trials failed; they are missing from the numbers\n", failed);
  if (missing > 0) fmt::print("{} trials have not run yet; shoal sweep runs them\n", missing);
}

void write_all(SweptStudy& study) {
  const std::string folder = study.folder().string();
  const std::size_t written = study.write_tables();
  print_state(study.results());
  fmt::print("written: {}/tables, {} tables as {}\n", folder, written,
             listed(analysis::file_endings_of_tables()));
  for (const analysis::Table& table : study.tables()) {
    const auto unknown = analysis::unknown_to_latex(analysis::as_latex(table));
    if (unknown.empty()) continue;
    fmt::print("tables/{}.tex needs XeLaTeX or LuaLaTeX, for {}\n", table.name, listed(unknown));
  }
  if (study.claims().statements.empty()) return;
  for (const std::string& line : analysis::count_lines(study.claims())) {
    fmt::print("{} (shoal claims {})\n", line, folder);
  }
}

/// A column holds the longest verdict, indented as those of parts are, and a space.
constexpr std::size_t verdict_width = 16;

std::string verdicts(const std::vector<std::string>& texts) {
  std::string line;
  for (const std::string& text : texts) line += fmt::format("{:<{}}", text, verdict_width);
  return line;
}

void print_claim(const analysis::JudgedClaim& part, const Judgement& judgement) {
  const std::string margin(verdict_width * judgement.columns.size(), ' ');
  for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
    const std::string column = judgement.side_by_side() ? judgement.columns[c] + ": " : "";
    for (const std::string& line : analysis::claim_lines(part, c, judgement)) {
      fmt::print("{}  {}{}\n", margin, column, line);
    }
  }
}

void print_statement(const analysis::JudgedStatement& statement, const Judgement& judgement) {
  std::vector<std::string> texts;
  for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
    texts.push_back(statement.verdict_text(c));
  }
  const std::string number = statement.number ? fmt::format("{:<4}", statement.number) : "";
  fmt::print("{}{}{}  {}\n", verdicts(texts), number, statement.section, statement.says);
  const std::string margin(verdict_width * judgement.columns.size(), ' ');
  if (!statement.not_tested.empty()) fmt::print("{}  {}\n", margin, statement.not_tested);
  for (const analysis::JudgedClaim& part : statement.parts) {
    if (statement.parts.size() > 1) {
      std::vector<std::string> of_part;
      for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
        const auto verdict = part.verdict(c);
        of_part.push_back("  " + (verdict ? std::string(name_of(*verdict)) : "-"));
      }
      fmt::print("{}part: {}\n", verdicts(of_part), part.claim.says);
    }
    print_claim(part, judgement);
  }
}

}  // namespace

void show_tables(SweptStudy& study, bool summary) {
  const std::vector<analysis::Table>& tables = study.tables();
  // After a sweep, the first table: the one that the study begins with.
  const std::size_t shown = summary ? std::min<std::size_t>(1, tables.size()) : tables.size();
  for (std::size_t i = 0; i < shown; ++i) {
    fmt::print("{}:\n{}\n", tables[i].name, analysis::as_text(tables[i]));
  }
  write_all(study);
}

void tables(const std::string& folder, bool summary) {
  SweptStudy study(folder);
  show_tables(study, summary);
}

void claims(const std::string& folder) {
  SweptStudy study(folder);
  const Judgement& judgement = study.claims();
  if (judgement.statements.empty()) {
    throw InputError(folder +
                     ": the study has no claims; name a file of them with claims = \"...\"");
  }
  if (judgement.side_by_side()) fmt::print("{}\n", verdicts(judgement.columns));
  for (const analysis::JudgedStatement& statement : judgement.statements) {
    print_statement(statement, judgement);
  }
  print_state(study.results());
  fmt::print("{}\n", analysis::verdict_note(judgement));
  for (const std::string& line : analysis::count_lines(judgement)) fmt::print("{}\n", line);
}

}  // namespace shoal::program
