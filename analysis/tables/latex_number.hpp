#pragma once

#include <cstddef>
#include <string>

#include "shoal/analysis/tables/number.hpp"

namespace shoal::analysis {

/// The digits that all numbers at one place of a column are given room for.
struct LatexRoom {
  bool negative = false;
  std::size_t whole = 0, fraction = 0, exponent = 0;

  void take(const Number& number);

  /// As siunitx wants it: `-2.1e-2`.
  std::string table_format() const;
  /// Phantoms of what the number lacks, before it and behind its fraction; for math mode.
  std::string before(const Number& number) const;
  std::string after(const Number& number) const;
  /// The whole room before the point, and that from the point on; for math mode.
  std::string left() const;
  std::string right() const;
};

/// For a cell of siunitx: `-1.5e-9`.
std::string latex_number(const Number& number);

/// For math mode, from the point on: `.5\times 10^{-9}`.
std::string latex_from_point(const Number& number);

/// `\phantom{text}`, or nothing.
std::string latex_phantom(const std::string& text);

}  // namespace shoal::analysis
