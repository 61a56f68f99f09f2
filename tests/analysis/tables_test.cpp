#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "shoal/analysis/tables/latex_signs.hpp"
#include "shoal/analysis/tables/latex_text.hpp"
#include "shoal/analysis/tables/number.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

std::string printed(double value, Digits digits) {
  return numbers_of({.value = value, .digits = digits}).front().text();
}

std::string printed(double value, double plus_minus) {
  std::string text;
  for (const Number& number : numbers_of({.value = value,
                              .uncertainty = PlusMinus{plus_minus},
                              .digits = decimals_for(plus_minus)})) {
    text += (text.empty() ? "" : " +- ") + number.text();
  }
  return text;
}

Table of(Cell cell) {
  return {.name = "t", .columns = {{"what"}, {"x"}}, .rows = {{"a", std::move(cell)}}};
}

TEST(Digits, AreTwoOfTheUncertainty) {
  EXPECT_EQ(printed(77.536, 5.61), "77.5 +- 5.6");
  EXPECT_EQ(printed(77.536, 0.0561), "77.536 +- 0.056");
  EXPECT_EQ(printed(77.536, 12.4), "78 +- 12");
  EXPECT_EQ(printed(12338.0, 243.0), "12340 +- 240");
}

TEST(Digits, CountThoseOfTheRoundedUncertainty) {
  EXPECT_EQ(printed(1.2345, 0.0994), "1.234 +- 0.099");
  EXPECT_EQ(printed(1.2345, 0.0996), "1.23 +- 0.10");
  EXPECT_EQ(printed(50.0, 9.96), "50 +- 10");
}

TEST(Digits, AreSixWhereThereIsNoUncertainty) {
  EXPECT_EQ(printed(20.0, 0.0), "20 +- 0");
  EXPECT_EQ(printed(1.0 / 3.0, 0.0), "0.333333 +- 0");
}

TEST(Digits, ShareAPowerOfTenFarFromOne) {
  EXPECT_EQ(printed(-1.2e-9, 3.4e-11), "-1.200e-09 +- 0.034e-09");
  EXPECT_EQ(printed(1e-10, 3e-9), "0.1e-09 +- 3.0e-09");
  EXPECT_EQ(printed(6.02214e23, 1.2e20), "6.0221e+23 +- 0.0012e+23");
  EXPECT_EQ(printed(9.996e9, 2.3e7), "9.996e+09 +- 0.023e+09");
}

TEST(Digits, OfCountsAreAllOfThem) {
  EXPECT_EQ(printed(123456789012345.0, Digits::decimals(0)), "123456789012345");
}

TEST(Digits, OfANumberRoundedToZeroHaveNoSign) {
  EXPECT_EQ(printed(-0.04, Digits::decimals(1)), "0.0");
  EXPECT_EQ(printed(-0.06, Digits::decimals(1)), "-0.1");
  EXPECT_EQ(printed(-0.0, Digits::significant(3)), "0");
}

TEST(Digits, AreNotToBeHadOfAnUncertaintyThatIsNone) {
  EXPECT_THROW(decimals_for(-1.0), std::invalid_argument);
  EXPECT_THROW(decimals_for(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Tables, RefuseNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const std::string& name : Registry<TableFormat>::instance().names()) {
    const auto format = table_format(name);
    EXPECT_NO_THROW(format->print(of(Estimate{1.0})));
    EXPECT_THROW(format->print(of(Estimate{nan})), std::invalid_argument);
    EXPECT_THROW(format->print(of(Estimate{-inf})), std::invalid_argument);
    EXPECT_THROW(format->print(of(Estimate{1.0, PlusMinus{nan}})), std::invalid_argument);
    EXPECT_THROW(format->print(of(Estimate{1.0, Deviation{inf}})), std::invalid_argument);
    EXPECT_THROW(format->print(of(Estimate{1.0, Between{0.0, nan}})), std::invalid_argument);
    EXPECT_THROW(format->print(of(Estimate{1.0, Between{nan, 2.0}})), std::invalid_argument);
  }
}

TEST(Tables, RefuseWhatCannotBe) {
  EXPECT_THROW(as_text(of(Estimate{1.0, PlusMinus{-0.1}})), std::invalid_argument);
  EXPECT_THROW(as_text(of(Estimate{1.0, Between{2.0, 0.0}})), std::invalid_argument);
  EXPECT_NO_THROW(as_text(of(Estimate{1.0, Between{2.0, 3.0}})));  // BCa may leave the mean out
  EXPECT_THROW(as_text(of(Estimate{.value = 1.0, .n = -1})), std::invalid_argument);
  EXPECT_THROW(as_text(of(Estimate{.value = 1.0, .failed = -1})), std::invalid_argument);
  EXPECT_THROW(as_text(of(Missing{.failed = -1})), std::invalid_argument);
}

TEST(Tables, RefuseColumnsThatMixKinds) {
  Table table = of(Estimate{1.0, PlusMinus{0.1}});
  table.rows.push_back({"b", Estimate{2.0}});
  table.rows.push_back({"c", Missing{}});
  EXPECT_NO_THROW(as_text(table));
  table.rows.push_back({"d", "never"});
  EXPECT_THROW(as_text(table), std::invalid_argument);
  table.rows.back() = {"d", Estimate{1.0, Deviation{0.1}}};
  EXPECT_THROW(as_text(table), std::invalid_argument);
}

TEST(Tables, RefuseOtherShapesAndNames) {
  EXPECT_THROW(as_text(Table{}), std::invalid_argument);
  Table table = of(Missing{});
  table.rows.push_back({"b"});
  EXPECT_THROW(as_text(table), std::invalid_argument);
  table = of(Missing{});
  table.name = "a b";
  EXPECT_THROW(as_latex(table), std::invalid_argument);
}

TEST(Tables, HaveCsvWhoseColumnsHaveNamesOfTheirOwn) {
  Table table{.columns = {{"x", "m"}, {"x", "m"}, {"x_m"}}};
  EXPECT_EQ(as_csv(table), "x_m,x_m_2,x_m_3\n");
  table = {.columns = {{"p"}, {"q"}, {"p"}}, .rows = {{"a", "b", Missing{}}}};
  EXPECT_EQ(as_csv(table).substr(0, 12), "p_label,q,p\n") << "numbers that are all missing";
  table = {.columns = {{"difference"}, {"difference"}, {"difference"}, {"p"}},
           .rows = {{"a", Estimate{1.0}, Estimate{2.0}, Estimate{3.0}}}};
  EXPECT_EQ(as_csv(table), "difference_label,difference,difference_2,p\na,1,2,3\n")
      << "numbers keep the names that programs look for";
  table = {.columns = {{"x"}, {"x sd"}}, .rows = {{Estimate{1.0, Deviation{0.1}}, "y"}}};
  EXPECT_EQ(as_csv(table), "x,x_sd,x_sd_label\n1,0.1,y\n");
}

TEST(Tables, HaveCsvWhoseLabelsAreNoFormulas) {
  Table table{.columns = {{"label"}, {"x"}}};
  for (const char* label : {"=1+1", "+a", "-a", "@a", "-1.5", "a=b"}) {
    table.rows.push_back({std::string(label), Estimate{-2.0}});
  }
  EXPECT_EQ(as_csv(table), "label,x\n'=1+1,-2\n'+a,-2\n'-a,-2\n'@a,-2\n-1.5,-2\na=b,-2\n");
}

TEST(Tables, HaveCsvOfFullPrecision) {
  EXPECT_EQ(as_csv(of(Estimate{.value = 1.0 / 3.0,
                               .uncertainty = Between{-1e-300, 123456789.123},
                               .digits = Digits::decimals(1),
                               .n = 3})),
            "what,x,x_low,x_high,x_n,x_failed\n"
            "a,0.3333333333333333,-1e-300,123456789.123,3,0\n");
}

TEST(Tables, SayNOnceWhereItIsTheSame) {
  Table table = of(Estimate{.value = 1.0, .n = 5});
  table.rows.push_back({"b", Estimate{.value = 2.0, .n = 5}});
  EXPECT_EQ(as_text(table), "what  x\na     1\nb     2\n\nn = 5 throughout.\n");
}

TEST(Tables, MarkFailuresEvenWhereAllHadThem) {
  Table table = of(Estimate{.value = 1.0, .n = 4, .failed = 1});
  EXPECT_EQ(as_text(table), "what    x\na     1^a\n\n^a n = 4, 1 failed.\n");
  table.rows[0][1] = Estimate{.value = 1.0, .n = 4, .failed = 1, .not_run = 2};
  EXPECT_EQ(as_text(table), "what    x\na     1^a\n\n^a n = 4, 1 failed, 2 not run.\n");
  table.rows[0][1] = Missing{.failed = 5};
  EXPECT_EQ(as_text(table), "what  x\na     -^a\n\n^a all 5 failed.\n");
}

TEST(Tables, ShowHowManyReachedAnEventAndWhatElseIsToSay) {
  Table table = of(Estimate{.value = 1350.0,
                            .uncertainty = PlusMinus{40.0},
                            .digits = Digits::decimals(0),
                            .n = 20,
                            .reached = 18,
                            .remarks = {"Skewed."},
                            .each = {1.5, 2.0}});
  EXPECT_EQ(as_text(table),
            "what                        x\n"
            "a     1350 +- 40 (18 of 20)^a\n"
            "\nn = 20 throughout.\n^a Skewed.\n");
  EXPECT_EQ(as_csv(table),
            "what,x,x_plus_minus,x_n,x_failed,x_reached,x_remarks,x_each\n"
            "a,1350,40,20,0,18,Skewed.,1.5 2\n");
  EXPECT_NE(as_markdown(table).find("1350 ± 40 (18 of 20)<sup>a</sup>"), std::string::npos);
  EXPECT_NE(as_latex(table).find("(18 of 20)"), std::string::npos);
  table.rows[0][1] = Estimate{.value = 1.0, .n = 3, .reached = 4};
  EXPECT_THROW(as_text(table), std::invalid_argument);
}

TEST(Tables, TakeMoreMarksThanThereAreLetters) {
  Table table{.columns = {{"x"}}};
  table.rows.push_back({Estimate{.value = 1.0, .n = 100}});
  table.rows.push_back({Estimate{.value = 1.0, .n = 100}});
  for (int n = 1; n <= 28; ++n) table.rows.push_back({Estimate{.value = 1.0, .n = n}});
  EXPECT_NE(as_text(table).find("^z n = 26.\n^aa n = 27.\n^ab n = 28.\n"), std::string::npos);
}

TEST(Tables, PartedForLatexHaveTheirNotesOnceBelowTheLastPart) {
  Table table{.name = "t", .columns = {{"what"}}, .rows = {{"a"}}, .notes = {"Mean."}};
  for (int k = 0; k < 10; ++k) {
    table.columns.push_back({"a header of some " + std::to_string(k)});
    table.rows[0].push_back(Estimate{.value = 1.0 + k, .n = 5, .failed = k == 0 || k == 9 ? 1 : 0});
  }
  const std::string printed = as_latex(table);
  const std::string notes =
      "    Mean.\\par\n    n = 5 unless marked.\\par\n"
      "    \\mbox{\\textsuperscript{a}\\,n = 5, 1 failed.}\\quad\n  "
      "\\end{minipage}\n\\end{table}\n";
  EXPECT_TRUE(printed.ends_with(notes)) << printed;
  EXPECT_GT(printed.find("\\footnotesize"), printed.rfind("\\usebox0\n")) << printed;
  EXPECT_EQ(printed.find("\\textsuperscript{b}"), std::string::npos) << printed;
  EXPECT_NE(printed.find("\\par\\medskip"), std::string::npos) << printed;
}

TEST(Tables, NeedNoNotes) {
  EXPECT_EQ(as_text(of(Estimate{1.5})), "what    x\na     1.5\n");
}

TEST(Tables, NameTheirFormatsWhenOneIsUnknown) {
  EXPECT_EQ(table_format("latex")->print(of(Missing{})), as_latex(of(Missing{})));
  try {
    table_format("latx");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "there is no format \"latx\"; did you mean \"latex\"?");
  }
}

TEST(LatexText, EscapesCommandsAndLigatures) {
  EXPECT_EQ(latex_escaped("\\~^${}#_&%"),
            "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}\\$\\{\\}\\#\\_\\&\\%");
  EXPECT_EQ(latex_escaped("---a``-"), "-{}-{}-a`{}`-");
}

TEST(LatexText, SpellsGreekAndMathematics) {
  EXPECT_EQ(latex_escaped("Δθ ≤ 5°"), "$\\Delta$$\\theta$ $\\leq$ 5$^{\\circ}$");
  EXPECT_EQ(latex_escaped("a → ∞ – ß"), "a $\\rightarrow$ $\\infty$ -- \\ss{}");
  EXPECT_EQ(latex_escaped("Märzenbecher, Žižek"), "Märzenbecher, Žižek");
}

TEST(LatexText, SaysWhatHasNoSpelling) {
  EXPECT_EQ(unknown_to_latex("a 漢 Ö 🐟 漢"), (std::vector<std::string>{"漢", "🐟"}));
  Table table = of(Estimate{1.0});
  EXPECT_TRUE(as_latex(table).starts_with("% \\usepackage"));
  table.caption = "漢 and Δ";
  EXPECT_TRUE(as_latex(table).starts_with(
      "% Needs XeLaTeX or LuaLaTeX and a font that has 漢\n% \\usepackage"));
}

TEST(LatexText, SpellsUnits) {
  EXPECT_EQ(latex_with_unit("energy", "Wh"), "energy (\\si{Wh})");
  EXPECT_EQ(latex_with_unit("", "%"), "(\\si{\\percent})");
  EXPECT_EQ(latex_with_unit("a_b", "c_d"), "a\\_b (c\\_d)");
  EXPECT_EQ(latex_with_unit("n", ""), "n");
}

}  // namespace
}  // namespace shoal::analysis
