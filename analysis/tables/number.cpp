#include "shoal/analysis/tables/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace shoal::analysis {
namespace {

constexpr int most_decimals = 6;
constexpr int most_idle_zeros = 3;
constexpr double whole_numbers_end = 1e15;  // beyond, a double has no digits for them all

/// The power of ten of the first digit, as it is after rounding to `digits` significant ones.
int exponent_of(double number, int digits) {
  const std::string text = fmt::format("{:.{}e}", number, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

Number split(std::string text) {
  // Rounded to zero, a number has lost its sign.
  if (text.starts_with('-') &&
      text.substr(0, text.find('e')).find_first_of("123456789") == text.npos)
    text.erase(0, 1);
  Number number;
  const std::size_t e = std::min(text.find('e'), text.size());
  const std::size_t point = std::min(text.find('.'), e);
  number.whole = text.substr(0, point);
  number.fraction = text.substr(point, e - point);
  number.exponent = text.substr(e);
  return number;
}

std::string fixed(double number, int decimals) {
  if (decimals >= 0) return fmt::format("{:.{}f}", number, decimals);
  const double step = std::pow(10.0, -decimals);
  return fmt::format("{:.0f}", std::round(number / step) * step);
}

}  // namespace

std::vector<double> values_of(const Uncertainty& uncertainty) {
  if (const auto* plus_minus = std::get_if<PlusMinus>(&uncertainty)) return {plus_minus->by};
  if (const auto* deviation = std::get_if<Deviation>(&uncertainty)) return {deviation->sd};
  if (const auto* between = std::get_if<Between>(&uncertainty))
    return {between->low, between->high};
  return {};
}

std::vector<Number> numbers_of(const Estimate& estimate) {
  std::vector<double> values = values_of(estimate.uncertainty);
  values.insert(values.begin(), estimate.value);
  std::vector<Number> numbers;
  const int digits = estimate.digits.number;
  if (estimate.digits.count == Digits::Count::significant) {
    for (const double x : values) numbers.push_back(split(fmt::format("{:.{}g}", x, digits)));
    return numbers;
  }
  const double largest =
      std::abs(*std::ranges::max_element(values, {}, [](double x) { return std::abs(x); }));
  const bool power_of_ten =
      digits > most_decimals || digits < -most_idle_zeros || largest >= whole_numbers_end;
  if (!power_of_ten || largest == 0.0) {
    for (const double x : values)
      numbers.push_back(split(fixed(x, std::min(digits, most_decimals))));
    return numbers;
  }
  // At least the digit before the point, and never more than a double has.
  const int significant = std::clamp(digits + exponent_of(largest, 17) + 1, 1, 17);
  const int exponent = exponent_of(largest, significant);
  const int decimals = std::clamp(digits + exponent, 0, 16);
  for (const double x : values) {
    numbers.push_back(split(fixed(x / std::pow(10.0, exponent), decimals)));
    numbers.back().exponent = fmt::format("e{:+03}", exponent);
  }
  return numbers;
}

Digits decimals_for(double uncertainty) {
  if (!std::isfinite(uncertainty) || uncertainty < 0.0) {
    throw std::invalid_argument("an uncertainty is finite and not negative");
  }
  if (uncertainty == 0.0) return Digits::significant(6);
  return Digits::decimals(1 - exponent_of(uncertainty, 2));
}

}  // namespace shoal::analysis
