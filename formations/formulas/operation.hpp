#pragma once

#include <cmath>
#include <cstdint>

namespace shoal::formations::formulas {

/// What a formula is made of. The leaves come first, then what has two operands, then one.
enum class Operation : std::uint8_t {
  number,
  distance,    // r
  separation,  // s
  add,
  subtract,
  multiply,
  divide,
  power,
  minimum,
  maximum,
  is_less,  // 1 or 0; in derivatives of minimum and maximum
  negate,
  sign,  // -1, 0 or 1; in derivatives of absolute
  absolute,
  square_root,
  exponential,
  logarithm,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
};

inline bool is_leaf(Operation o) {
  return o <= Operation::separation;
}
inline bool is_binary(Operation o) {
  return o >= Operation::add && o <= Operation::is_less;
}

/// The operation on its operands (`b` is of no account to those that have one). A value that is not
/// a number stays one through minimum and maximum.
inline double applied(Operation o, double a, double b) {
  switch (o) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return std::pow(a, b);
    case Operation::minimum:
      return a < b || std::isnan(a) ? a : b;
    case Operation::maximum:
      return a > b || std::isnan(a) ? a : b;
    case Operation::is_less:
      return a < b ? 1.0 : 0.0;
    case Operation::negate:
      return -a;
    case Operation::sign:
      return static_cast<double>(a > 0.0) - static_cast<double>(a < 0.0);
    case Operation::absolute:
      return std::abs(a);
    case Operation::square_root:
      return std::sqrt(a);
    case Operation::exponential:
      return std::exp(a);
    case Operation::logarithm:
      return std::log(a);
    case Operation::sine:
      return std::sin(a);
    case Operation::cosine:
      return std::cos(a);
    case Operation::tangent:
      return std::tan(a);
    case Operation::arcsine:
      return std::asin(a);
    case Operation::arccosine:
      return std::acos(a);
    case Operation::arctangent:
      return std::atan(a);
    case Operation::hyperbolic_sine:
      return std::sinh(a);
    case Operation::hyperbolic_cosine:
      return std::cosh(a);
    case Operation::hyperbolic_tangent:
      return std::tanh(a);
    case Operation::number:
    case Operation::distance:
    case Operation::separation:
      break;
  }
  __builtin_unreachable();  // leaves are not applied; saves a test at every step of a program
}

}  // namespace shoal::formations::formulas
