// What a file of claims makes of its tests: verdicts of statements, correction, causes, refusals.

#include <gtest/gtest.h>

#include "shoal/analysis/experiments/claims/claim_text.hpp"
#include "tests/analysis/chosen_trials.hpp"
#include "tests/core/settings.hpp"

namespace shoal::analysis {
namespace {

using namespace chosen_trials;
using tests::complaint_of;

class Claims : public ChosenTrials {};

TEST_F(Claims, HaveOneVerdictAStatementAndColumnCorrectedOverAll) {
  const std::string in_calm =
      "groups = [\"calm\"]\nwhere = { period = 10 }\nmeasure = \"energy_mean_wh\"\n";
  const auto file = [&](const std::string& correction) {
    return "correction = \"" + correction +
           "\"\nside_by_side = \"settings\"\n"
           "[[statement]]\nnumber = 2\nsays = \"both\"\nsection = \"1.2\"\n"
           "[[statement]]\nnumber = 1\nsays = \"never\"\nnot_tested = \"no measure of it\"\n"
           "[[claim]]\nstatement = 2\nsays = \"less\"\n" +
           in_calm + "test = " + lower("smallest_effect = 1") +
           "\n[[claim]]\nstatement = 2\nsays = \"at most 11 Wh\"\n" + in_calm +
           "test = { kind = \"between\", between.at_most = 11 }\n"
           "[[claim]]\nsays = \"alone\"\n" +
           in_calm + "test = { kind = \"between\", between.at_most = 9.99 }\n";
  };
  // Under `text` rigid spends less than pairwise, under `program` more.
  const Gave gave = [](const Place& p) {
    const double rigid_wh = p.label("settings") == "text" ? 8.0 : 12.0;
    return Measures{
        {"energy_mean_wh", (is_rigid(p) ? rigid_wh : 10.0) + noise_of(p.k + is_rigid(p))}};
  };
  const Judgement judgement = judged(file("holm"), gave);
  EXPECT_EQ(judgement.columns, (std::vector<std::string>{"text", "program"}));
  ASSERT_EQ(judgement.statements.size(), 3u);
  const JudgedStatement& untested = judgement.statements[0];
  EXPECT_EQ(untested.verdict_text(0), "not tested");
  const JudgedStatement& both = judgement.statements[1];
  ASSERT_EQ(both.parts.size(), 2u);
  EXPECT_EQ(both.verdict_text(0), "reproduced");
  EXPECT_EQ(both.verdict_text(1), "contradicted");
  EXPECT_EQ(judgement.family, 6) << "three claims in two columns";
  EXPECT_EQ(count_lines(judgement)[0],
            "text: 3 statements: 1 reproduced, 0 contradicted, 1 undecided, 1 not tested");

  // Holm by hand: p-values in order times 6, 5, 4 ..., each at least the one before.
  std::vector<std::pair<double, double>> p;  // as it is, corrected
  for (const JudgedStatement& statement : judgement.statements) {
    for (const JudgedClaim& part : statement.parts) {
      for (const auto& column : part.columns) {
        p.emplace_back(std::min({1.0, column->result.p_holds, column->result.p_fails}),
                       column->corrected_p);
      }
    }
  }
  std::ranges::sort(p);
  double before = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    before = std::min(1.0, std::max(before, p[i].first * static_cast<double>(6 - i)));
    EXPECT_NEAR(p[i].second, before, 1e-12);
  }
  EXPECT_EQ(judged(file("none"), gave).statements[1].parts[0].columns[0]->result.correction, 1.0);
  const Table table = claims_table(judgement);
  ASSERT_EQ(table.rows.size(), 5u) << "three statements, and the two parts of one";
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_FALSE(as_latex(table).empty());
}

TEST_F(Claims, ThatTheCorrectionLeavesUndecidedSaySo) {
  std::string file;
  for (int i = 0; i < 30; ++i) {
    file +=
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmeasure = \"energy_mean_wh\"\nwhere = { "
        "settings = "
        "\"text\", period = 10, behaviour = \"rigid_registration\" }\n"
        "test = { kind = \"between\", between.at_most = 10.35 }\n";
  }
  const Judgement judgement = judged(file, [](const Place& p) {
    return Measures{{"energy_mean_wh", 10.0 + noise_of(p.k)}};
  });
  const JudgedColumn& column = *judgement.statements[0].parts[0].columns[0];
  EXPECT_LT(column.result.p_holds, 0.05);
  EXPECT_TRUE(column.result.corrected_away());
  EXPECT_NEAR(column.corrected_p, std::min(1.0, 30.0 * column.result.p_holds), 1e-12);
  EXPECT_NE(contrast_text(column.result, column.result.contrasts[0])
                .find("decided only without the correction"),
            std::string::npos);
  EXPECT_GT(*column.result.replications_needed(), 8);
}

TEST_F(Claims, NameACauseOnlyIfItsOwnTestHolds) {
  const auto lines = [&](const std::string& cause) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\ngroups = [\"calm\"]\nmeasure = \"energy_mean_wh\"\n"
        "where = { settings = \"text\", period = 10 }\ntest = " +
            lower("smallest_effect = 1") +
            "\n[claim.cause]\nsays = \"it fragments\"\nmeasure = \"fragments\"\n"
            "where = { settings = \"text\", period = 10, behaviour = \"rigid_registration\" }\n" +
            cause,
        [](const Place& p) {
          return Measures{
              {"energy_mean_wh", (is_rigid(p) ? 12.0 : 10.0) + noise_of(p.k + is_rigid(p))},
              {"fragments", 3.0 + noise_of(p.k)}};
        });
    return claim_lines(judgement.statements[0].parts[0], 0, judgement);
  };
  const auto held = lines("test = { kind = \"between\", between.at_least = 2 }");
  EXPECT_EQ(held[held.size() - 2], "cause: it fragments");
  EXPECT_EQ(held.back().substr(0, 6), "  3 [2");
  EXPECT_EQ(lines("test = { kind = \"between\", between.at_least = 4 }").back(),
            "no cause established");
  EXPECT_EQ(lines("test = { kind = \"between\", between.at_least = 2 }\nstudy = \"other\"").back(),
            "run shoal sweep other to see the cause");
  // The study itself, stored beside, as the other one.
  EXPECT_EQ(lines("groups = [\"calm\"]\ntest = { kind = \"between\", between.at_least = 2 }\nstudy "
                  "= \"study\"")
                .back(),
            held.back());
}

TEST_F(Claims, ThatAreNotWrittenRightAreRefusedByLine) {
  const auto complaint = [&](const std::string& claim) {
    return complaint_of([&] {
      read_claims(scenarios::parse_toml("[[claim]]\nsays = \"so\"\n" + claim, "claims.toml"));
    });
  };
  EXPECT_EQ(
      complaint("measure = \"fragments\"\ncause = \"the sea\"\ntest = { kind = \"between\", "
                "between.at_most = 1 }"),
      "claims.toml:4: a cause is not a text but a statement with a test of its own: write "
      "[claim.cause] with says, measure and test (and study, if other trials show it), or leave "
      "it out");
  EXPECT_EQ(complaint("metric = \"fragments\"\n"),
            "claims.toml:3: metric is now measure; write that");
  EXPECT_NE(complaint("measure = \"fragments\"\ntest = " + lower("smallest_effect = 0"))
                .find("needs smallest_effect or smallest_effect_percent, above 0"),
            std::string::npos);
  EXPECT_NE(complaint("measure = \"fragments\"\ntest = " +
                      lower("smallest_effect = 1, smallest_effect_percent = 1"))
                .find("not both"),
            std::string::npos);
  EXPECT_NE(
      complaint(
          "measure = \"fragments\"\nat_s = 3\ntest = { kind = \"between\", between.at_most = 1 }")
          .find("at_s and since_s belong to a series"),
      std::string::npos);
  const std::string of_3 =
      "statement = 3\nmeasure = \"fragments\"\ntest = { kind = \"between\", between.at_most = 1 "
      "}\n";
  EXPECT_EQ(complaint(of_3), "");
  EXPECT_NE(
      complaint(of_3 + "[[claim]]\nsays = \"more\"\n" + of_3).find("statement 3 has several parts"),
      std::string::npos);
  EXPECT_NE(complaint(of_3 + "[[statement]]\nnumber = 4\nsays = \"none\"\n")
                .find("statement 4 has no [[claim]]"),
            std::string::npos);
}

TEST_F(Claims, OnWhatTheStudyLacksAreRefused) {
  const auto complaint = [&](const std::string& more) {
    return complaint_of([&] {
      judged(
          "side_by_side = \"settings\"\n[[claim]]\nsays = \"so\"\nmeasure = \"energy_mean_wh\"\n" +
              more + "\ntest = " + lower("smallest_effect = 1"),
          [](const Place&) { return Measures{}; });
    });
  };
  const std::string file = (folder_ / "claims.toml").string();
  EXPECT_EQ(complaint("groups = [\"calm\"]\nwhere = { perod = 10 }"),
            file + ":2: the group calm has no factor \"perod\"; did you mean \"period\"?");
  EXPECT_EQ(complaint("groups = [\"calm\"]\nwhere = { period = 15 }"),
            file + ":2: no cell of the study is as `where` says");
  EXPECT_EQ(complaint("where = { period = 10 }"),
            file + ":2: the study has several groups; say which the claim is about");
}

}  // namespace
}  // namespace shoal::analysis
