#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "shoal/formations/formulas/operation.hpp"
#include "shoal/formations/formulas/tree.hpp"
#include "shoal/formations/potential.hpp"

namespace shoal::formations::formulas {

/// A formula and its derivatives as a list of steps, each computed once, into a register of its
/// own.
///
/// Registers: r, s, the constants, then one a step. The value comes first and needs its own steps
/// only. Evaluation allocates nothing and keeps no state.
class Program {
 public:
  static constexpr std::size_t max_registers = 1000;

  double value(double r, double s) const;
  RadialValue derivatives(double r, double s) const;

  /// The same for one separation, with less to do: what does not depend on r is a constant, and
  /// pairs of steps are joined. It gives the same bits.
  Program at(double s) const;

 private:
  friend class ProgramBuilder;

  /// An operation of a and b, or two: of a and b, then of the result and c (program.cpp: joined).
  struct Step {
    std::uint8_t code;
    std::uint16_t a, b, c;
  };
  static constexpr std::size_t least_constants = 8;  // copied as a block, without a loop

  std::size_t first_step() const { return 2 + constants_.size(); }  // its register
  template <bool plain>
  void run(double r, double s, std::size_t steps, double* registers) const;
  void join_steps();

  std::vector<double> constants_ = std::vector<double>(least_constants);
  std::vector<Step> steps_;
  std::size_t value_steps_ = 0;
  bool is_plain_ = false;                 // no step calls a function
  std::array<std::size_t, 3> results_{};  // registers of value, slope, curvature
};

/// Whole exponents up to this size become multiplications, and are exact for GiNaC.
inline constexpr double largest_whole_power = 64.0;

/// Collects the steps of a program; the same step is taken once only.
class ProgramBuilder {
 public:
  /// What a step works on: r, s, a constant or the result of a step.
  using Operand = int;
  static constexpr Operand distance = 0;
  static constexpr Operand separation = 1;

  Operand constant(double value);
  /// Throws InputError when the program grows out of bounds.
  Operand step(Operation operation, Operand a, Operand b = distance);
  Operand power(Operand base, double exponent);
  /// Appends a formula as it was written; returns the operand that each node has become (numbers
  /// that are exponents only are none).
  std::vector<Operand> append(const Tree& tree);

  /// The steps so far give the value.
  void value_is(Operand value);
  Program finished(Operand slope, Operand curvature) const;

 private:
  std::vector<double> constants_;  // the operand of the k-th is -1 - k
  std::vector<std::tuple<Operation, Operand, Operand>> steps_;
  std::map<std::tuple<Operation, Operand, Operand>, Operand> known_;
  std::size_t value_steps_ = 0;
  Operand value_ = distance;
};

}  // namespace shoal::formations::formulas
