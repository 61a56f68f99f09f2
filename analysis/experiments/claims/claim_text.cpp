#include "shoal/analysis/experiments/claims/claim_text.hpp"

#include <fmt/format.h>

#include <map>

#include "shoal/analysis/experiments/results/confidence.hpp"

namespace shoal::analysis {
namespace {

std::string count_text(const Contrast& contrast) {
  std::string text = contrast.n == contrast.trials
                         ? fmt::format("n = {}", contrast.n)
                         : fmt::format("{} of {} trials have a value", contrast.n, contrast.trials);
  if (contrast.never_reached > 0) {
    text += fmt::format(", {} of them without the event, taken at the end of their watch",
                        contrast.never_reached);
  }
  return text;
}

std::string reason(const ClaimResult& result, const Contrast& contrast) {
  switch (result.verdict_of(contrast)) {
    case Verdict::reproduced:
      return "as claimed";
    case Verdict::contradicted:
      return contrast.against == Against::opposite    ? "the opposite"
             : contrast.against == Against::too_small ? "no difference that matters"
                                                      : "not as claimed";
    case Verdict::undecided:
      break;
  }
  if (!contrast.p_holds) return "too few trials, or no scatter, to decide";
  const double least = std::min(*contrast.p_holds, *contrast.p_fails);
  if (contrast.of_each) return "trials without a value may differ";
  return least < significance ? "decided only without the correction" : "undecided";
}

std::string p_text(double p) {
  return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p);
}

std::vector<std::string> lines_of(const ClaimResult& result) {
  std::vector<std::string> lines;
  for (const Contrast& contrast : result.contrasts)
    lines.push_back(contrast_text(result, contrast));
  return lines;
}

std::vector<std::string> cause_lines(const Claim& claim, const JudgedColumn& column) {
  if (column.cause && !column.cause->missing_study.empty()) {
    return {"run shoal sweep " + column.cause->missing_study + " to see the cause"};
  }
  if (!column.cause || !column.cause->established()) return {"no cause established"};
  std::vector<std::string> lines{"cause: " + claim.cause->says};
  for (const std::string& line : lines_of(*column.cause->result)) lines.push_back("  " + line);
  return lines;
}

void add_rows(Table& table, const JudgedStatement& statement, const Judgement& judgement) {
  const bool one = statement.parts.size() == 1;
  const auto numbers = [&](const JudgedClaim& part) {
    std::string text;
    for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
      if (!part.columns[c]) continue;
      std::string of_column;
      for (const std::string& line : claim_lines(part, c, judgement)) {
        of_column += (of_column.empty() ? "" : "; ") + line;
      }
      if (judgement.side_by_side()) of_column = judgement.columns[c] + ": " + of_column;
      text += (text.empty() ? "" : " | ") + of_column;
    }
    return text;
  };
  std::vector<Cell> row{statement.number ? std::to_string(statement.number) : "", statement.section,
                        statement.says};
  for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
    row.emplace_back(statement.verdict_text(c));
  }
  row.emplace_back(one ? numbers(statement.parts.front()) : statement.not_tested);
  table.rows.push_back(std::move(row));
  if (one) return;
  for (const JudgedClaim& part : statement.parts) {
    std::vector<Cell> below{std::string(), std::string(), "part: " + part.claim.says};
    for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
      const std::optional<Verdict> verdict = part.verdict(c);
      below.emplace_back(verdict ? std::string(name_of(*verdict)) : "-");
    }
    below.emplace_back(numbers(part));
    table.rows.push_back(std::move(below));
  }
}

}  // namespace

std::string contrast_text(const ClaimResult& result, const Contrast& contrast) {
  std::string text = contrast.title.empty() ? "" : contrast.title + ": ";
  const std::string unit = contrast.unit.empty() ? "" : " " + contrast.unit;
  if (!contrast.quantity.empty()) text += contrast.quantity + " ";
  if (!contrast.estimate) {
    text += "no value";
  } else if (contrast.of_each) {
    text += fmt::format("from {:.4g} to {:.4g}{}", contrast.interval->low, contrast.interval->high,
                        unit);
  } else {
    text += fmt::format("{:.4g}{}", *contrast.estimate, unit);
    if (contrast.interval) {
      text += fmt::format(" [{:.4g}, {:.4g}]", contrast.interval->low, contrast.interval->high);
    }
  }
  return text + ", claimed " + contrast.claimed + ", " + count_text(contrast) + ": " +
         reason(result, contrast);
}

std::vector<std::string> claim_lines(const JudgedClaim& judged, std::size_t column,
                                     const Judgement& judgement) {
  if (!judged.columns[column]) return {};
  const JudgedColumn& shown = *judged.columns[column];
  const ClaimResult& result = shown.result;
  std::vector<std::string> lines = lines_of(result);
  if (result.inferred()) {
    std::string text = p_text(std::min({1.0, result.p_holds, result.p_fails}));
    if (judgement.correction == Correction::holm && judgement.family > 1) {
      text += fmt::format("; {} corrected over {} verdicts", p_text(shown.corrected_p),
                          judgement.family);
    }
    lines.push_back(text);
  }
  if (const auto needed = result.replications_needed()) {
    lines.push_back(fmt::format("about {} replications would decide", *needed));
  }
  if (result.verdict() == Verdict::contradicted) {
    for (std::string& line : cause_lines(judged.claim, shown)) lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<std::string> count_lines(const Judgement& judgement) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
    std::map<std::string, int> counts;
    int about = 0;
    for (const JudgedStatement& statement : judgement.statements) {
      const std::string verdict = statement.verdict_text(c);
      if (verdict != "-") ++about;
      ++counts[verdict];
    }
    std::string line =
        fmt::format("{} statements: {} reproduced, {} contradicted, {} undecided", about,
                    counts["reproduced"], counts["contradicted"], counts["undecided"]);
    if (counts["not tested"] > 0) line += fmt::format(", {} not tested", counts["not tested"]);
    lines.push_back(judgement.side_by_side() ? judgement.columns[c] + ": " + line : line);
  }
  return lines;
}

std::string verdict_note(const Judgement& judgement) {
  std::string text =
      "Intervals are of 95 %. Reproduced: all comparisons of a statement are as claimed, by their "
      "p-values; contradicted: one is not, or falls short of the smallest effect that matters. ";
  if (judgement.family == 0) return text + "None of these verdicts rests on a p-value.";
  if (judgement.correction == Correction::none) return text + "Not corrected for their number.";
  return text +
         fmt::format("p-values are corrected by Holm's method over {} verdicts.", judgement.family);
}

Table claims_table(const Judgement& judgement) {
  Table table{"claims",
              "Statements, and what the trials say to them",
              {{.header = "no.", .name = "number"}, {.header = "section"}, {.header = "statement"}},
              {},
              {verdict_note(judgement)}};
  for (const std::string& column : judgement.columns) {
    if (column.empty()) table.columns.push_back({.header = "verdict"});
    if (!column.empty()) table.columns.push_back({.header = column, .name = "verdict_" + column});
  }
  table.columns.push_back({.header = "numbers"});
  for (const JudgedStatement& statement : judgement.statements) {
    add_rows(table, statement, judgement);
  }
  return table;
}

}  // namespace shoal::analysis
