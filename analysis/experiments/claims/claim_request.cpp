#include "shoal/analysis/experiments/claims/claim_request.hpp"

#include <algorithm>
#include <set>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/study/renamed_keys.hpp"

namespace shoal::analysis {
namespace {

template <class T>
void declare_tested(Options<T>& o) {
  o.text("says", &T::says, "the statement");
  o.texts("groups", &T::groups, "the groups of the study it is about");
  o.setting("where", &T::where, "a table: factor = label or labels", "the cells it is about");
  o.text("measure", &T::measure, "the number it is about (shoal list measures)");
  o.text("series", &T::series, "or a number against time");
  o.number("at_s", &T::at_s, "s", at_least(0), "the time of the series");
  o.number("since_s", &T::since_s, "s", at_least(0),
           "it is about the change of the series from this time to at_s; default: about its value");
  o.text("minus", &T::minus, "the number is less this one of the same trial, measure or series");
  o.template word<Average>("statistic", &T::average,
                           {{"mean", Average::mean}, {"median", Average::median}},
                           "what of the numbers over trials is tested");
  o.template choice<ClaimTest>("test", &T::test, "the test that the statement becomes");
}

Cause cause_of(const Setting& written) {
  if (!written.is_table()) {
    throw InputError(written.origin,
                     "a cause is not a text but a statement with a test of its own: write "
                     "[claim.cause] with says, measure and test (and study, if other trials show "
                     "it), or leave it out");
  }
  Cause cause;
  read(cause, written, "cause");
  cause.require_known();
  return cause;
}

/// Throws InputError if the statements and the claims do not belong together.
void require_parts(const ClaimFile& file) {
  std::set<std::int64_t> worded;
  for (const StatementWords& statement : file.statements) {
    const std::string name = "statement " + std::to_string(statement.number);
    if (!worded.insert(statement.number).second) {
      throw InputError(statement.origin, "there are two [[statement]]s of number " +
                                             std::to_string(statement.number));
    }
    const auto parts = std::ranges::count(file.claims, statement.number, &Claim::statement);
    if (parts == 0 && statement.not_tested.empty()) {
      throw InputError(statement.origin,
                       name + " has no [[claim]]; add one, or say why with not_tested = \"...\"");
    }
    if (parts > 0 && !statement.not_tested.empty()) {
      throw InputError(statement.origin, name + " has a [[claim]]; leave not_tested out");
    }
  }
  std::set<std::int64_t> seen;
  for (const Claim& claim : file.claims) {
    if (claim.statement == 0 || worded.contains(claim.statement)) continue;
    if (seen.insert(claim.statement).second) continue;
    throw InputError(claim.origin, "statement " + std::to_string(claim.statement) +
                                       " has several parts; add a [[statement]] of that number "
                                       "with the words that they are parts of");
  }
}

}  // namespace

std::string TestedStatement::unit() const {
  return series.empty() ? known_value(measure, origin).unit : known_series(series, origin).unit;
}

std::optional<std::string> TestedStatement::complaint() const {
  if (says.empty()) return "a claim says something";
  if (measure.empty() == series.empty()) return "a claim needs a measure or a series";
  if (series.empty() && (at_s != 0.0 || of_a_change()))
    return "at_s and since_s belong to a series";
  if (of_a_change() && since_s >= at_s) return "since_s must be before at_s";
  return std::nullopt;
}

void TestedStatement::require_known() const {
  const bool of_series = measure.empty();
  const auto known = [&](const std::string& name) {
    return of_series ? known_series(name, origin) : known_value(name, origin);
  };
  const Quantity quantity = known(of_series ? series : measure);
  if (!minus.empty() && known(minus).unit != quantity.unit) {
    throw InputError(origin, quantity.name + " is in " + quantity.unit + " and " + minus +
                                 " in another unit; their difference means nothing");
  }
  test.make();
}

void Cause::declare(Options<Cause>& o) {
  declare_tested(o);
  o.text("study", &Cause::study,
         "whose stored trials show it, beside the folder of the claim's or in out/; default: the "
         "claim's own");
}

void Claim::declare(Options<Claim>& o) {
  o.integer("statement", &Claim::statement, "", in(0, 1e9),
            "number of the statement that it is a part of; 0: it stands alone");
  o.text("section", &Claim::section, "where it is stated");
  declare_tested(o);
  o.setting("cause", &Claim::written_cause, "a table: says, measure, test ...",
            "what may be behind a contradiction; printed only if its own test holds");
}

void StatementWords::declare(Options<StatementWords>& o) {
  o.integer("number", &StatementWords::number, "", in(1, 1e9), "in the list of its source");
  o.text("section", &StatementWords::section, "where it is stated");
  o.text("says", &StatementWords::says, "the statement");
  o.text("not_tested", &StatementWords::not_tested, "why no claim tests it");
}

std::optional<std::string> StatementWords::complaint() const {
  if (number == 0) return "a statement needs a number";
  if (says.empty()) return "a statement says something";
  return std::nullopt;
}

void ClaimFile::declare(Options<ClaimFile>& o) {
  o.word("correction", &ClaimFile::correction,
         {{"holm", Correction::holm}, {"none", Correction::none}},
         "of the p-values over all verdicts of the file");
  o.text("side_by_side", &ClaimFile::side_by_side,
         "the factor whose levels get verdicts of their own; default: none");
  o.tables("statement", &ClaimFile::statements,
           "the words of statements with several parts, and of those that are not tested");
  o.tables("claim", &ClaimFile::claims, "statements on the trials of a study, or parts of them");
}

ClaimFile read_claims(const Setting& root) {
  ClaimFile file;
  require_no_renamed_keys(root);
  read(file, root, "");
  for (Claim& claim : file.claims) {
    claim.require_known();
    const bool none = claim.written_cause.is_table() && claim.written_cause.table().empty();
    if (none) continue;
    claim.cause = cause_of(claim.written_cause);
    const bool same_trials = claim.cause->study.empty() && claim.cause->groups.empty();
    if (same_trials) claim.cause->groups = claim.groups;
  }
  require_parts(file);
  return file;
}

std::vector<const TestedStatement*> tested_on_the_study(const ClaimFile& file) {
  std::vector<const TestedStatement*> all;
  for (const Claim& claim : file.claims) {
    all.push_back(&claim);
    if (claim.cause && claim.cause->study.empty()) all.push_back(&*claim.cause);
  }
  return all;
}

}  // namespace shoal::analysis
