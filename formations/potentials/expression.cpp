#include "shoal/formations/potentials/expression.hpp"

#include <memory>

#include "shoal/core/text.hpp"
#include "shoal/formations/formula.hpp"

namespace shoal::formations {
namespace {

std::string quoted(const std::string& formula) {
  constexpr std::size_t shown = 80;
  return "formula \"" + formula.substr(0, shown) + (formula.size() > shown ? "..." : "") + "\": ";
}

class ExpressionPotential final : public Potential {
 public:
  explicit ExpressionPotential(const Expression& written)
      : written_(written), formula_(written.formula, written.parameters) {}

  double value(double r, double s) const override { return formula_.value(r, s); }
  RadialValue derivatives(double r, double s) const override { return formula_.derivatives(r, s); }

  void prepare(double separation_m) override { formula_.prepare(separation_m); }

  std::optional<std::string> complaint(double separation_m) const override {
    if (separation_m < written_.from_m || separation_m > written_.to_m) {
      return "the separation, " + shortest(separation_m) + " m, is not between from_m and to_m";
    }
    const auto trouble = formula_.trouble(written_.from_m, written_.to_m, separation_m);
    if (!trouble) return std::nullopt;
    return quoted(written_.formula) + *trouble +
           "; change it, or the range from_m to to_m that it is meant for";
  }

 private:
  Expression written_;
  Formula formula_;
};

const Register<Potential, Expression> registered{
    "expression", "a formula of your own in r and s",
    [](const Expression& written) { return std::make_unique<ExpressionPotential>(written); }};

}  // namespace

std::optional<std::string> Expression::complaint() const {
  if (!(from_m < to_m)) return "from_m must be below to_m";
  try {
    Formula{formula, parameters};
  } catch (const InputError& error) {
    return quoted(formula) + error.what();
  }
  return std::nullopt;
}

void Expression::declare(Options<Expression>& o) {
  o.text("formula", &Expression::formula,
         "cost of the distance r and the separation s, in metres: + - * / ^ and sqrt exp log sin "
         "cos tan asin acos atan sinh cosh tanh abs min max pow pi");
  o.named_numbers("parameters", &Expression::parameters,
                  "values of the names in the formula; a study's factor sweeps parameters.NAME");
  o.number("from_m", &Expression::from_m, "m", above(0),
           "smallest distance at which the formula and two derivatives must be finite");
  o.number("to_m", &Expression::to_m, "m", above(0), "largest such distance");
}

}  // namespace shoal::formations
