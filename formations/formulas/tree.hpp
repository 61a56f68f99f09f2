#pragma once

#include <string_view>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/formations/formulas/operation.hpp"

namespace shoal::formations::formulas {

/// A formula as it was written: operands stand before what uses them, the last node is the whole.
/// Parts without r and s are numbers already.
struct Tree {
  struct Node {
    Operation operation = Operation::number;
    int a = -1;  // operands, as indices of nodes
    int b = -1;
    double number = 0.0;
  };
  std::vector<Node> nodes;
};

/// Reads `s^3/(2*r^2) + r - 3*s`: numbers, r, s, pi, + - * / ^ (from the right: 2^3^2 = 2^9, and
/// -2^2 = -4), brackets, functions (sqrt, exp, log ...), and names that stand for numbers. Throws
/// InputError with one sentence that says what is wrong and at which character, or which name does
/// not occur. Time and depth are bounded whatever the text.
Tree parsed(std::string_view text, const NamedNumbers& named_numbers = {});

}  // namespace shoal::formations::formulas
