#include "shoal/analysis/study/claim_request.hpp"

#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

struct ClaimFile {
  std::vector<Claim> claims;

  static constexpr const char* noun = "a file of claims";
  static void declare(Options<ClaimFile>& o) {
    o.tables("claim", &ClaimFile::claims, "statements on the trials of a study");
  }
};

}  // namespace

void Claim::declare(Options<Claim>& o) {
  o.text("section", &Claim::section, "where it is stated");
  o.text("says", &Claim::says, "the statement");
  o.texts("groups", &Claim::groups, "the groups of the study it is about");
  o.setting("where", &Claim::where, "a table: factor = label or labels", "the cells it is about");
  o.text("metric", &Claim::metric, "the number it is about (shoal list measures)");
  o.text("series", &Claim::series, "or a number against time");
  o.number("at_s", &Claim::at_s, "s", at_least(0), "the time of the series");
  o.text("cause", &Claim::cause, "the likely cause if trials contradict it; printed only then");
  o.choice("test", &Claim::test, "the test that the statement becomes");
}

std::optional<std::string> Claim::complaint() const {
  if (says.empty()) return "a claim says something";
  if (metric.empty() == series.empty()) return "a claim needs a metric or a series";
  if (series.empty() && at_s != 0.0) return "at_s belongs to a series";
  return std::nullopt;
}

std::vector<Claim> read_claims(const Setting& root) {
  ClaimFile file;
  read(file, root, "");
  for (const Claim& claim : file.claims) {
    if (!claim.metric.empty()) known_value(claim.metric, claim.origin);
    if (!claim.series.empty()) known_series(claim.series, claim.origin);
    claim.test.make();
  }
  return std::move(file.claims);
}

}  // namespace shoal::analysis
