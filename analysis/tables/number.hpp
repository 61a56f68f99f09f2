#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// A printed number, taken apart where it is aligned: `-12` `.5` `e-09`.
struct Number {
  std::string whole, fraction, exponent;

  std::string text() const { return whole + fraction + exponent; }
};

/// The value, and then the numbers of its uncertainty: none, one or two. All have the same power
/// of ten where they are written with one.
std::vector<Number> numbers_of(const Estimate& estimate);

/// The numbers of an uncertainty.
std::vector<double> values_of(const Uncertainty& uncertainty);

}  // namespace shoal::analysis
