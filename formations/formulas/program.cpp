#include "shoal/formations/formulas/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>

#include "shoal/core/error.hpp"

namespace shoal::formations::formulas {

namespace {

constexpr int first_joined = 32;  // codes below are Operations

bool is_arithmetic(int code) {
  return code >= static_cast<int>(Operation::add) && code <= static_cast<int>(Operation::divide);
}

/// The code of `second` after `first`; `swapped` if the first result is the second operand.
constexpr int joined(Operation first, Operation second, bool swapped) {
  const auto place = [](Operation o) {
    return static_cast<int>(o) - static_cast<int>(Operation::add);
  };
  return first_joined + (swapped ? 16 : 0) + 4 * place(first) + place(second);
}

/// `plain`: of what calls a function there is nothing.
template <bool plain>
inline double computed(int code, double a, double b, double c) {
  switch (code) {
#define SHOAL_JOINED(first, second)                                        \
  case joined(Operation::first, Operation::second, false):                 \
    return applied(Operation::second, applied(Operation::first, a, b), c); \
  case joined(Operation::first, Operation::second, true):                  \
    return applied(Operation::second, c, applied(Operation::first, a, b));
#define SHOAL_JOINED_AFTER(first) \
  SHOAL_JOINED(first, add)        \
  SHOAL_JOINED(first, subtract)   \
  SHOAL_JOINED(first, multiply)   \
  SHOAL_JOINED(first, divide)
    SHOAL_JOINED_AFTER(add)
    SHOAL_JOINED_AFTER(subtract)
    SHOAL_JOINED_AFTER(multiply)
    SHOAL_JOINED_AFTER(divide)
#undef SHOAL_JOINED_AFTER
#undef SHOAL_JOINED
    // Found by the same jump as the joined ones.
    case static_cast<int>(Operation::add):
      return a + b;
    case static_cast<int>(Operation::subtract):
      return a - b;
    case static_cast<int>(Operation::multiply):
      return a * b;
    case static_cast<int>(Operation::divide):
      return a / b;
    case static_cast<int>(Operation::negate):
      return -a;
    case static_cast<int>(Operation::square_root):
      return std::sqrt(a);
    default:
      if constexpr (plain) __builtin_unreachable();
      return applied(static_cast<Operation>(code), a, b);
  }
}

}  // namespace

template <bool plain>
[[gnu::always_inline]] inline void Program::run(double r, double s, std::size_t steps,
                                                double* registers) const {
  registers[0] = r;
  registers[1] = s;
  std::memcpy(registers + 2, constants_.data(), least_constants * sizeof(double));
  for (std::size_t i = least_constants; i < constants_.size(); ++i)
    registers[2 + i] = constants_[i];
  double* next = registers + first_step();
  for (const Step* step = steps_.data(); steps > 0; --steps, ++step) {
    *next++ =
        computed<plain>(step->code, registers[step->a], registers[step->b], registers[step->c]);
  }
}

double Program::value(double r, double s) const {
  double registers[max_registers];
  is_plain_ ? run<true>(r, s, value_steps_, registers) : run<false>(r, s, value_steps_, registers);
  return registers[results_[0]];
}

RadialValue Program::derivatives(double r, double s) const {
  double registers[max_registers];
  const std::size_t steps = steps_.size();
  is_plain_ ? run<true>(r, s, steps, registers) : run<false>(r, s, steps, registers);
  return {registers[results_[0]], registers[results_[1]], registers[results_[2]]};
}

Program Program::at(double s) const {
  // Of each register: its value, if that is known.
  std::vector<std::optional<double>> known(first_step() + steps_.size());
  known[1] = s;
  std::ranges::copy(constants_, known.begin() + 2);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (known[step.a] && known[step.b]) {
      known[first_step() + i] = computed<false>(step.code, *known[step.a], *known[step.b], 0.0);
    }
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (!known[first_step() + i]) kept.push_back(i);
  }

  Program bound;
  std::vector<double> constants;
  std::map<std::size_t, std::size_t> moved{{0, 0}};  // register here -> register there
  const auto note = [&](std::size_t here) {
    if (!known[here] || !moved.try_emplace(here, 2 + constants.size()).second) return;
    constants.push_back(*known[here]);
  };
  for (const std::size_t i : kept) {
    note(steps_[i].a);
    note(steps_[i].b);
  }
  std::ranges::for_each(results_, note);
  if (constants.size() > least_constants) bound.constants_.resize(constants.size());
  std::ranges::copy(constants, bound.constants_.begin());

  const auto there = [&](std::size_t here) { return static_cast<std::uint16_t>(moved.at(here)); };
  for (const std::size_t i : kept) {
    moved[first_step() + i] = bound.first_step() + bound.steps_.size();
    bound.steps_.push_back({steps_[i].code, there(steps_[i].a), there(steps_[i].b), 0});
    if (i < value_steps_) bound.value_steps_ = bound.steps_.size();
  }
  std::ranges::transform(results_, bound.results_.begin(), there);
  bound.join_steps();
  return bound;
}

// Arithmetic whose result is used once only, by arithmetic, becomes one step with it.
void Program::join_steps() {
  std::vector<int> uses(first_step() + steps_.size());
  for (const Step& step : steps_) {
    ++uses[step.a];
    if (is_binary(static_cast<Operation>(step.code))) ++uses[step.b];
  }
  for (const std::size_t result : results_) uses[result] += 2;

  std::vector<bool> is_gone(steps_.size());
  for (Step& step : steps_) {
    if (!is_arithmetic(step.code)) continue;
    for (const bool swapped : {false, true}) {
      const std::size_t operand = swapped ? step.b : step.a;
      if (operand < first_step() || uses[operand] > 1) continue;
      const std::size_t j = operand - first_step();
      if (!is_arithmetic(steps_[j].code)) continue;
      const auto code = joined(static_cast<Operation>(steps_[j].code),
                               static_cast<Operation>(step.code), swapped);
      step = {static_cast<std::uint8_t>(code), steps_[j].a, steps_[j].b, swapped ? step.a : step.b};
      is_gone[j] = true;
      break;
    }
  }

  std::vector<std::size_t> moved(uses.size());
  std::vector<Step> left;
  std::size_t value_steps = 0;
  std::iota(moved.begin(), moved.end(), 0);
  const auto there = [&](std::size_t here) { return static_cast<std::uint16_t>(moved[here]); };
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (is_gone[i]) continue;
    const Step& step = steps_[i];
    moved[first_step() + i] = first_step() + left.size();
    left.push_back({step.code, there(step.a), there(step.b), there(step.c)});
    if (i < value_steps_) value_steps = left.size();
  }
  is_plain_ = std::ranges::all_of(left, [](const Step& step) {
    const auto operation = static_cast<Operation>(step.code);
    return is_arithmetic(step.code) || step.code >= first_joined ||
           operation == Operation::negate || operation == Operation::square_root;
  });
  steps_ = std::move(left);
  value_steps_ = value_steps;
  for (std::size_t& result : results_) result = moved[result];
}

ProgramBuilder::Operand ProgramBuilder::constant(double value) {
  const auto found = std::ranges::find(constants_, value);
  const auto index = static_cast<Operand>(found - constants_.begin());
  if (found == constants_.end()) constants_.push_back(value);
  return -1 - index;
}

ProgramBuilder::Operand ProgramBuilder::step(Operation operation, Operand a, Operand b) {
  const bool commutes = operation == Operation::add || operation == Operation::multiply;
  const std::tuple key(operation, commutes ? std::min(a, b) : a, commutes ? std::max(a, b) : b);
  const auto [place, is_new] = known_.try_emplace(key, 2 + static_cast<Operand>(steps_.size()));
  if (is_new) steps_.push_back(key);
  // Room is left for r, s, s as a constant (at()) and derivatives that are constants.
  if (5 + std::max(constants_.size(), Program::least_constants) + steps_.size() >
      Program::max_registers) {
    throw InputError("it is too long: it and its derivatives take more than " +
                     std::to_string(Program::max_registers) + " steps");
  }
  return place->second;
}

ProgramBuilder::Operand ProgramBuilder::power(Operand base, double exponent) {
  if (exponent == 0.0) return constant(1.0);
  if (exponent == 1.0) return base;
  if (exponent == 0.5) return step(Operation::square_root, base);
  if (exponent < 0.0) return step(Operation::divide, constant(1.0), power(base, -exponent));
  if (exponent != std::floor(exponent) || exponent > largest_whole_power) {
    return step(Operation::power, base, constant(exponent));
  }
  const bool odd = std::fmod(exponent, 2.0) != 0.0;
  if (odd) return step(Operation::multiply, power(base, exponent - 1.0), base);
  const Operand half = power(base, 0.5 * exponent);
  return step(Operation::multiply, half, half);
}

std::vector<ProgramBuilder::Operand> ProgramBuilder::append(const Tree& tree) {
  std::vector<Operand> operands;
  const auto operand = [&](int node) {
    const auto& n = tree.nodes[static_cast<std::size_t>(node)];
    return n.operation == Operation::number ? constant(n.number)
                                            : operands[static_cast<std::size_t>(node)];
  };
  for (const Tree::Node& n : tree.nodes) {
    if (n.operation == Operation::number || n.operation == Operation::distance) {
      operands.push_back(distance);  // a number becomes a constant where it is used
    } else if (n.operation == Operation::separation) {
      operands.push_back(separation);
    } else if (n.operation == Operation::power &&
               tree.nodes[static_cast<std::size_t>(n.b)].operation == Operation::number) {
      operands.push_back(power(operand(n.a), tree.nodes[static_cast<std::size_t>(n.b)].number));
    } else {
      operands.push_back(step(n.operation, operand(n.a), n.b < 0 ? distance : operand(n.b)));
    }
  }
  return operands;
}

void ProgramBuilder::value_is(Operand value) {
  value_ = value;
  value_steps_ = steps_.size();
}

Program ProgramBuilder::finished(Operand slope, Operand curvature) const {
  Program program;
  if (constants_.size() > program.constants_.size()) program.constants_.resize(constants_.size());
  std::ranges::copy(constants_, program.constants_.begin());
  const auto place = [&](Operand operand) {
    if (operand < 0) return static_cast<std::size_t>(1 - operand);
    return static_cast<std::size_t>(operand) + (operand < 2 ? 0 : program.constants_.size());
  };
  for (const auto& [operation, a, b] : steps_) {
    program.steps_.push_back({static_cast<std::uint8_t>(operation),
                              static_cast<std::uint16_t>(place(a)),
                              static_cast<std::uint16_t>(place(is_binary(operation) ? b : a)), 0});
  }
  program.value_steps_ = value_steps_;
  program.results_ = {place(value_), place(slope), place(curvature)};
  return program;
}

}  // namespace shoal::formations::formulas
