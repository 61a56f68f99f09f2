#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "shoal/formations/formulas/program.hpp"

namespace shoal::formations {

/// A function of the distance r and the separation s (m) that was written as text.
///
/// Numbers, r, s, pi, parameters, + - * / ^, brackets, and sqrt, exp, log (natural), sin, cos, tan,
/// asin, acos, atan, sinh, cosh, tanh, abs, min, max, pow. Evaluation is thread-safe and allocates
/// nothing.
class Formula {
 public:
  /// Throws InputError with one sentence that says what is wrong, and where.
  explicit Formula(std::string_view text, const NamedNumbers& parameters = {});

  double value(double r, double s) const { return for_(s).value(r, s); }
  /// The derivatives are symbolic.
  RadialValue derivatives(double r, double s) const { return for_(s).derivatives(r, s); }

  /// Computes ahead what depends on this separation only. The numbers do not change.
  void prepare(double s);

  /// Where the formula or one of its first two derivatives is not finite between two distances (m),
  /// as a sentence, or nothing. Looks at thousands of distances, and for poles between them.
  std::optional<std::string> trouble(double from_m, double to_m, double s) const;

 private:
  const formulas::Program& for_(double s) const { return s == prepared_s_ ? prepared_ : program_; }

  formulas::Program program_;
  formulas::Program prepared_;
  double prepared_s_ = std::numeric_limits<double>::quiet_NaN();  // equals none
};

}  // namespace shoal::formations
