#include "shoal/formations/formula.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "shoal/core/error.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::formations {
namespace {

std::string wrong_with(const std::string& text, const NamedNumbers& parameters = {}) {
  try {
    Formula{text, parameters};
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

double value_of(const std::string& text, double r = 2.0, double s = 3.0) {
  return Formula(text).value(r, s);
}

TEST(Formula, IsReadAsItIsWritten) {
  EXPECT_EQ(value_of("r + 2*3"), 8.0);
  EXPECT_EQ(value_of("2^3^2 + r - r"), 512.0);
  EXPECT_EQ(value_of("-r^2"), -4.0);
  EXPECT_EQ(value_of("r^-2"), 0.25);
  EXPECT_EQ(value_of("8/r/2"), 2.0);
  EXPECT_EQ(value_of("8 - r - 1"), 5.0);
  EXPECT_EQ(value_of("--r+-+r"), 0.0);
  EXPECT_EQ(value_of(" ( r\t+ s ) *2\n"), 10.0);
  EXPECT_EQ(value_of("1.5e1*r + .5"), 30.5);
  EXPECT_EQ(value_of("cos(pi)*r"), -2.0);
  EXPECT_EQ(value_of("min(r, s) + 10*max(r, s) + abs(r - s)"), 33.0);
  EXPECT_EQ(value_of("pow(r, 3) + r^0.5"), 8.0 + std::sqrt(2.0));
  EXPECT_EQ(value_of("s^3/(2*r^2) + r - 3*s", 150.0, 300.0), -150.0);
}

struct FormulaCase {
  const char* text;
  double (*cpp)(double r, double s);
};

/// Every function, and what GiNaC might simplify: beside the same in C++ and its differences.
const std::vector<FormulaCase> cases{
    {"s^3/(2*r^2) + r - 3*s",
     [](double r, double s) { return s * s * s / (2 * r * r) + r - 3 * s; }},
    {"s^3/r^3.5 - (s/r)^64",
     [](double r, double s) { return s * s * s / std::pow(r, 3.5) - std::pow(s / r, 64); }},
    {"(r - s)^3 + (s - r)^2 - 7",
     [](double r, double s) { return std::pow(r - s, 3) + std::pow(s - r, 2) - 7; }},
    {"sqrt(r^2 + s^2)", [](double r, double s) { return std::sqrt(r * r + s * s); }},
    {"exp(-r/s)*log(r*s)", [](double r, double s) { return std::exp(-r / s) * std::log(r * s); }},
    {"sin(r) + cos(r/s)*tan(r/9)",
     [](double r, double s) { return std::sin(r) + std::cos(r / s) * std::tan(r / 9); }},
    {"asin(r/20) + acos(r/20) + atan(r^2)*r",
     [](double r, double) { return std::asin(r / 20) + std::acos(r / 20) + std::atan(r * r) * r; }},
    {"sinh(r/s) - cosh(r/3) + tanh(r - s)",
     [](double r, double s) { return std::sinh(r / s) - std::cosh(r / 3) + std::tanh(r - s); }},
    {"r^s + s^r + 2^r",
     [](double r, double s) { return std::pow(r, s) + std::pow(s, r) + std::pow(2, r); }},
    {"abs(r - s)^3 + abs(log(r/4))",
     [](double r, double s) { return std::pow(std::abs(r - s), 3) + std::abs(std::log(r / 4)); }},
    {"min(r^2, 3*s)*max(abs(r - 1), s/r)",
     [](double r, double s) { return std::min(r * r, 3 * s) * std::max(std::abs(r - 1), s / r); }},
    {"-(r + s)/(1 + 1/(1 + r))", [](double r, double s) { return -(r + s) / (1 + 1 / (1 + r)); }},
    {"0.1*r - 0.1*s - 0.3", [](double r, double s) { return 0.1 * r - 0.1 * s - 0.3; }},
};

TEST(Formula, HasTheValueAndTheDerivativesOfTheSameInCpp) {
  for (const FormulaCase& c : cases) {
    const Formula formula(c.text);
    for (const double r : {0.7, 2.3, 4.9}) {
      const double s = 2.9;
      const double h = 1e-3 * r;
      const auto f = [&](double x) { return c.cpp(x, s); };
      const RadialValue exact = formula.derivatives(r, s);
      const double slope = (8 * (f(r + h) - f(r - h)) - (f(r + 2 * h) - f(r - 2 * h))) / (12 * h);
      const double curvature =
          (16 * (f(r + h) + f(r - h)) - (f(r + 2 * h) + f(r - 2 * h)) - 30 * f(r)) / (12 * h * h);
      const double size = 1.0 + std::abs(f(r)) + std::abs(exact.slope) + std::abs(exact.curvature);
      EXPECT_NEAR(exact.value, f(r), 1e-13 * size) << c.text;
      EXPECT_EQ(exact.value, formula.value(r, s)) << c.text;
      // (s/r)^64 at r = 0.7 bends within h; the differences are what is wrong there.
      EXPECT_NEAR(exact.slope, slope, 1e-6 * size) << c.text << " at r = " << r;
      EXPECT_NEAR(exact.curvature, curvature, 1e-5 * size) << c.text << " at r = " << r;
    }
  }
}

TEST(Formula, HasExactDerivativesOfAPolynomial) {
  const Formula formula("3*r^4 - 2*r*s + s^2");
  const RadialValue f = formula.derivatives(2.0, 5.0);
  EXPECT_EQ(f.value, 48.0 - 20.0 + 25.0);
  EXPECT_EQ(f.slope, 96.0 - 10.0);
  EXPECT_EQ(f.curvature, 144.0);
}

TEST(Formula, HasNoSlopeWhereItIsConstant) {
  const RadialValue f = Formula("max(r, s)").derivatives(2.0, 5.0);
  EXPECT_EQ(f.value, 5.0);
  EXPECT_EQ(f.slope, 0.0);
  EXPECT_EQ(f.curvature, 0.0);
}

TEST(Formula, GivesTheSameBitsPreparedOrNotAndMadeAgain) {
  for (const FormulaCase& c : cases) {
    const Formula once(c.text);
    Formula again(c.text);
    again.prepare(2.9);
    for (const double r : {0.7, 2.3, 4.9}) {
      for (const double s : {2.9, 3.1}) {
        const RadialValue a = once.derivatives(r, s);
        const RadialValue b = again.derivatives(r, s);
        EXPECT_EQ(a.value, b.value) << c.text;
        EXPECT_EQ(a.slope, b.slope) << c.text;
        EXPECT_EQ(a.curvature, b.curvature) << c.text;
        EXPECT_EQ(once.value(r, s), again.value(r, s)) << c.text;
      }
    }
  }
}

// GiNaC orders its terms by addresses, which differ from run to run; the bits must not.
TEST(Formula, GivesTheSameBitsInEveryRun) {
  const Formula formula("(r-s)*(r+s)*(r-s-0.1)/(r+s+0.1)/s + (s-r-3.3)^3/s^2 - (0.3*s-r)/r^2");
  const RadialValue f = formula.derivatives(250.3, 300.0);
  EXPECT_EQ(f.value, 0x1.2b8f32a1f47dep+3);
  EXPECT_EQ(f.slope, -0x1.9d0df16232713p-2);
  EXPECT_EQ(f.curvature, 0x1.3fc4a640e3d88p-7);
}

TEST(Formula, SaysWhatIsWrongWithAText) {
  EXPECT_EQ(wrong_with(""), "it is empty");
  EXPECT_EQ(wrong_with("  "), "it is empty");
  EXPECT_EQ(wrong_with("r + q"),
            "there is no symbol \"q\"; known are r (distance, m), s (separation, m) and pi "
            "(character 5)");
  EXPECT_EQ(wrong_with("lgo(r)"),
            "there is no function \"lgo\"; did you mean \"log\"? (character 1)");
  EXPECT_EQ(wrong_with("2*sin"), "sin is a function; write sin(...) (character 3)");
  EXPECT_EQ(wrong_with("min(r)"), "min takes two values, separated by a comma (character 6)");
  EXPECT_EQ(wrong_with("exp(r, s)"), "exp takes one value (character 6)");
  EXPECT_EQ(wrong_with("min(r, s, 1)"), "min takes two values (character 9)");
  EXPECT_EQ(wrong_with("s^^2"), "a value is expected, not '^' (character 3)");
  EXPECT_EQ(wrong_with("r +"), "it ends where a value is expected (character 4)");
  EXPECT_EQ(wrong_with("()"), "a value is expected before ')' (character 2)");
  EXPECT_EQ(wrong_with("2r"), "an operator is missing before 'r' (character 2)");
  EXPECT_EQ(wrong_with("1..2*r"), "an operator is missing before '.' (character 3)");
  EXPECT_EQ(wrong_with("((r)"), "this '(' is never closed (character 1)");
  EXPECT_EQ(wrong_with("(r))"), "there is a ')' too many (character 4)");
  EXPECT_EQ(wrong_with("(r s)"), "an operator or ')' is missing before 's' (character 4)");
  EXPECT_EQ(wrong_with("r + \xc3\xa9"),
            "a value is expected, not a character that is not ASCII (character 5)");
  EXPECT_EQ(wrong_with(std::string("r\0+", 3)),
            "an operator is missing before a control character (character 2)");
  EXPECT_EQ(wrong_with("5"), "it does not depend on the distance r");
  EXPECT_EQ(wrong_with("1/0 + r"), "the value of this part is not finite (inf) (character 2)");
  EXPECT_EQ(wrong_with("r*9^9^9^9"), "the value of this part is not finite (inf) (character 6)");
  EXPECT_EQ(wrong_with("r*1e999"), "this number is too large or too small (character 3)");
  EXPECT_EQ(wrong_with("1/(r - r)").substr(0, 26), "it has no derivative: powe");
}

TEST(Formula, HasParametersThatStandForNumbers) {
  // Morse's potential, as it is written with and without names.
  const NamedNumbers named{{"depth", 5.0}, {"a2", 0.02}};
  const Formula with("depth*(1 - exp(-a2*(r - s)))^2", named);
  const Formula without("5*(1 - exp(-0.02*(r - s)))^2");
  for (const double r : {1.0, 250.0, 300.0, 700.0}) {
    const RadialValue a = with.derivatives(r, 300.0), b = without.derivatives(r, 300.0);
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.slope, b.slope);
    EXPECT_EQ(a.curvature, b.curvature);
  }
  EXPECT_EQ(wrong_with("depth*r", {{"depth", 2.0}}), "");
}

TEST(Formula, SaysWhatIsWrongWithAParameter) {
  EXPECT_EQ(wrong_with("k*r", {{"j", 1.0}}),
            "there is no symbol \"k\"; known are r (distance, m), s (separation, m), j and pi "
            "(character 1)");
  EXPECT_EQ(wrong_with("r", {{"k", 1.0}}), "it does not have the parameter k");
  EXPECT_EQ(wrong_with("k", {{"k", 1.0}}), "it does not depend on the distance r");
  for (const std::string name : {"r", "s", "pi", "exp"}) {
    EXPECT_EQ(wrong_with("r", {{name, 1.0}}),
              "the parameter " + name + " needs another name: " + name + " has a meaning already");
  }
  EXPECT_EQ(wrong_with("k*r", {{"k", 1.0}, {"k", 2.0}}),
            "the parameter k needs another name: k has a meaning already");
  for (const std::string name : {"", "2k", "a b", "k'", "\xc3\xa9"}) {
    EXPECT_EQ(wrong_with("r", {{name, 1.0}}),
              "a parameter is named by letters, digits and _, a letter first; not \"" + name + '"');
  }
}

TEST(Formula, KeepsHostileTextsInBounds) {
  const auto repeated = [](const char* text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  EXPECT_EQ(wrong_with(repeated("r+", 400)), "it has 800 characters; at most 500 are read");
  EXPECT_EQ(wrong_with(repeated("(", 200)).substr(0, 36), "it is nested deeper than 50 levels (");
  EXPECT_EQ(wrong_with(repeated("-", 400) + "r").substr(0, 36),
            "it is nested deeper than 50 levels (");
  EXPECT_EQ(wrong_with("((((3*r)^64)^64)^64)^64"),
            "its derivative has a factor that is not finite");
  EXPECT_EQ(wrong_with(repeated("(r+s)*(r+1/r)*", 35) + "r"), "");
  std::string factors = "r";
  for (int i = 10; i < 90; ++i) factors += "*(r+" + std::to_string(i) + ")";
  EXPECT_EQ(wrong_with(factors.substr(0, 498)),
            "it is too long: it and its derivatives take more than 1000 steps");
  wrong_with(repeated("r^", 45) + "r");  // whatever it says, it comes back
  wrong_with(repeated("tan(", 45) + "r" + repeated(")", 45));
}

TEST(Formula, FindsWhereItIsNotFinite) {
  const auto trouble = [](const char* text) {
    return Formula(text).trouble(0.1, 10'000.0, 300.0).value_or("none");
  };
  EXPECT_EQ(trouble("s^3/(2*r^2) + r - 3*s"), "none");
  EXPECT_EQ(trouble("abs(r - s)"), "none");
  EXPECT_EQ(trouble("log(r - 100)"), "it is not a number at r = 0.1 m for s = 300 m");
  EXPECT_EQ(trouble("1/(r - s)"), "it is infinite at r = 300 m for s = 300 m");
  EXPECT_EQ(trouble("1/(r - 100)^2"), "it is infinite at r = 100 m for s = 300 m");
  EXPECT_EQ(trouble("1/(r - 100.55)"), "it is not finite at r = 100.55 m for s = 300 m");
  EXPECT_EQ(trouble("1/(r - 100.55)^2"),
            "its first derivative is not finite at r = 100.55 m for s = 300 m");
  EXPECT_EQ(trouble("abs(r - s)^1.5"),
            "its second derivative is not a number at r = 300 m for s = 300 m");
  EXPECT_EQ(trouble("exp(r)"), "it is infinite at r = 709.986 m for s = 300 m");
}

TEST(Formula, IsReadAndEvaluatedByManyThreadsAtOnce) {
  std::array<std::vector<double>, 4> results;
  {
    std::vector<std::thread> threads;
    for (auto& result : results) {
      threads.emplace_back([&result] {
        for (const FormulaCase& c : cases) {
          const RadialValue f = Formula(c.text).derivatives(2.3, 2.9);
          result.insert(result.end(), {f.value, f.slope, f.curvature});
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST(Formula, AllocatesNothingWhenItIsEvaluated) {
  Formula formula("min(s^3/(2*r^2), exp(r/s)) + r^2.5");
  const auto before = shoal::tests::allocations();
  double sum = formula.derivatives(2.0, 3.0).slope + formula.value(3.0, 3.0);
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
  formula.prepare(3.0);
  const auto prepared = shoal::tests::allocations();
  sum += formula.derivatives(2.0, 3.0).slope + formula.value(3.0, 3.0);
  EXPECT_EQ(shoal::tests::allocations() - prepared, 0u);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace shoal::formations
