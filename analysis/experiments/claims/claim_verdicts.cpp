#include "shoal/analysis/experiments/claims/claim_verdicts.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/analysis/statistics/holm.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

/// `where`, with one level of a factor; as it is, for no factor.
Setting at_level(Setting where, const std::string& factor, const std::string& label) {
  if (!factor.empty()) where.at_or_new(factor).value = label;
  return where;
}

bool has_factor(const TrialList& list, const std::string& factor) {
  return std::ranges::all_of(list.groups(), [&](const TrialGroup& group) {
    return std::ranges::find(group.columns(), factor) != group.columns().end();
  });
}

/// The levels of the factor that the file of claims compares side by side, over all its claims.
std::vector<std::string> columns_of(const ClaimFile& file, const TrialList& list) {
  if (file.side_by_side.empty()) return {""};
  std::vector<std::string> columns;
  for (const Claim& claim : file.claims) {
    for (const std::string& label : levels_of(file.side_by_side, claim, list)) {
      if (std::ranges::find(columns, label) == columns.end()) columns.push_back(label);
    }
  }
  return columns.empty() ? std::vector<std::string>{""} : columns;
}

JudgedClaim tested(const Claim& claim, const std::string& factor,
                   const std::vector<std::string>& columns, const StudyResults& results) {
  JudgedClaim judged{claim, {}};
  std::vector<std::string> own{""};
  if (!factor.empty()) own = levels_of(factor, claim, results.list());
  for (const std::string& column : columns) {
    auto& at = judged.columns.emplace_back();
    if (std::ranges::find(own, column) == own.end()) continue;
    at = JudgedColumn{test_claim(claim, at_level(claim.where, factor, column), results), 1.0, {}};
  }
  return judged;
}

/// Corrects all verdicts that infer something, and counts them.
int correct(std::vector<JudgedClaim>& claims, Correction correction) {
  std::vector<JudgedColumn*> family;
  std::vector<double> p_values;
  for (JudgedClaim& claim : claims) {
    for (auto& column : claim.columns) {
      if (!column || !column->result.inferred()) continue;
      family.push_back(&*column);
      p_values.push_back(std::min({1.0, column->result.p_holds, column->result.p_fails}));
    }
  }
  const std::vector<double> corrected =
      correction == Correction::holm ? statistics::holm(p_values) : p_values;
  const auto all = correction == Correction::holm ? static_cast<double>(family.size()) : 1.0;
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i]->corrected_p = corrected[i];
    // The contrasts of an undecided claim are held against the strictest level of the family.
    const double factor = p_values[i] > 0.0 ? corrected[i] / p_values[i] : 1.0;
    family[i]->result.correction = corrected[i] < significance ? factor : std::max(all, factor);
  }
  return static_cast<int>(family.size());
}

std::optional<fs::path> stored_study(const std::string& name, const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& place :
       {fs::absolute(folder).lexically_normal().parent_path() / name, fs::path("out") / name}) {
    if (fs::exists(place / "study.toml", ignored)) return place;
  }
  return std::nullopt;
}

/// What a cause asks of the trials of another study.
StudyResults asked_results(const Cause& cause, const fs::path& folder) {
  std::vector<std::string> names{cause.series.empty() ? cause.measure : cause.series};
  if (!cause.minus.empty()) names.push_back(cause.minus);
  const Store store(folder, Store::Access::read);
  const std::vector<std::string> none;
  return {stored_list(folder), store, cause.series.empty() ? names : none,
          cause.series.empty() ? none : names};
}

JudgedCause judged_cause(const Cause& cause, const std::string& factor, const std::string& column,
                         const StudyResults& results, const fs::path& folder) {
  if (cause.study.empty()) {
    return {test_claim(cause, at_level(cause.where, factor, column), results), ""};
  }
  const std::optional<fs::path> other = stored_study(cause.study, folder);
  if (!other) return {std::nullopt, cause.study};
  const StudyResults theirs = asked_results(cause, *other);
  const bool at_column = !factor.empty() && has_factor(theirs.list(), factor);
  return {test_claim(cause, at_level(cause.where, at_column ? factor : "", column), theirs), ""};
}

/// Statements by their number, then the claims that stand alone.
std::vector<JudgedStatement> in_statements(std::vector<JudgedClaim> claims, const ClaimFile& file) {
  std::map<std::int64_t, JudgedStatement> numbered;
  std::vector<JudgedStatement> alone;
  for (const StatementWords& statement : file.statements) {
    numbered[statement.number] = {
        statement.number, statement.section, statement.says, statement.not_tested, {}};
  }
  for (JudgedClaim& judged : claims) {
    const Claim& claim = judged.claim;
    JudgedStatement own{claim.statement, claim.section, claim.says, "", {}};
    JudgedStatement& statement = claim.statement == 0
                                     ? alone.emplace_back(std::move(own))
                                     : numbered.try_emplace(claim.statement, own).first->second;
    if (statement.section.empty()) statement.section = claim.section;
    statement.parts.push_back(std::move(judged));
  }
  std::vector<JudgedStatement> all;
  for (auto& [number, statement] : numbered) all.push_back(std::move(statement));
  std::ranges::move(alone, std::back_inserter(all));
  return all;
}

}  // namespace

std::optional<Verdict> JudgedClaim::verdict(std::size_t column) const {
  return columns[column] ? std::optional(columns[column]->result.verdict()) : std::nullopt;
}

std::optional<Verdict> JudgedStatement::verdict(std::size_t column) const {
  std::optional<Verdict> all;
  for (const JudgedClaim& part : parts) {
    const std::optional<Verdict> verdict = part.verdict(column);
    if (!verdict) continue;
    if (*verdict == Verdict::contradicted) return verdict;
    if (!all || *verdict == Verdict::undecided) all = verdict;
  }
  return all;
}

std::string JudgedStatement::verdict_text(std::size_t column) const {
  if (!not_tested.empty()) return "not tested";
  const std::optional<Verdict> found = verdict(column);
  return found ? std::string(name_of(*found)) : "-";
}

Judgement judged_claims(const StudyResults& results, const fs::path& folder) {
  const ClaimFile& file = results.list().study().claims;
  Judgement judgement{.columns = columns_of(file, results.list()), .correction = file.correction};
  std::vector<JudgedClaim> claims;
  for (const Claim& claim : file.claims) {
    claims.push_back(tested(claim, file.side_by_side, judgement.columns, results));
  }
  judgement.family = correct(claims, file.correction);
  for (JudgedClaim& claim : claims) {
    for (std::size_t c = 0; c < claim.columns.size(); ++c) {
      if (!claim.claim.cause || claim.verdict(c) != Verdict::contradicted) continue;
      claim.columns[c]->cause = judged_cause(*claim.claim.cause, file.side_by_side,
                                             judgement.columns[c], results, folder);
    }
  }
  judgement.statements = in_statements(std::move(claims), file);
  return judgement;
}

void require_answerable_claims(const StudyResults& results) {
  const ClaimFile& file = results.list().study().claims;
  const std::vector<std::string> columns = columns_of(file, results.list());
  for (const Claim& claim : file.claims) {
    tested(claim, file.side_by_side, columns, results);
    if (claim.cause && claim.cause->study.empty()) {
      test_claim(*claim.cause, claim.cause->where, results);
    }
  }
}

}  // namespace shoal::analysis
