#include "shoal/analysis/tables/latex_number.hpp"

#include <algorithm>

namespace shoal::analysis {
namespace {

std::string zeros(std::size_t count) {
  return std::string(count, '0');
}

bool minus(const Number& number) {
  return number.whole.starts_with('-');
}

std::size_t whole_digits(const Number& number) {
  return number.whole.size() - (minus(number) ? 1 : 0);
}

std::size_t fraction_digits(const Number& number) {
  return number.fraction.empty() ? 0 : number.fraction.size() - 1;
}

/// `e-09` as `-9`.
std::string power(const Number& number) {
  return std::to_string(std::stoi(number.exponent.substr(1)));
}

}  // namespace

void LatexRoom::take(const Number& number) {
  negative = negative || minus(number);
  whole = std::max(whole, whole_digits(number));
  fraction = std::max(fraction, fraction_digits(number));
  if (!number.exponent.empty()) {
    exponent = std::max(exponent, power(number).size() - (power(number).starts_with('-') ? 1 : 0));
  }
}

std::string LatexRoom::table_format() const {
  return (negative ? "-" : "") + std::to_string(whole) +
         (fraction > 0 ? "." + std::to_string(fraction) : "") +
         (exponent > 0 ? "e-" + std::to_string(exponent) : "");
}

std::string LatexRoom::before(const Number& number) const {
  return latex_phantom((negative && !minus(number) ? "-" : "") +
                       zeros(whole - whole_digits(number)));
}

std::string LatexRoom::after(const Number& number) const {
  const std::size_t digits = fraction_digits(number);
  return latex_phantom((fraction > 0 && digits == 0 ? "." : "") + zeros(fraction - digits));
}

std::string LatexRoom::left() const {
  return latex_phantom((negative ? "-" : "") + zeros(whole));
}

std::string LatexRoom::right() const {
  return latex_phantom((fraction > 0 ? "." + zeros(fraction) : "") +
                       (exponent > 0 ? "\\times 10^{-" + zeros(exponent) + "}" : ""));
}

std::string latex_number(const Number& number) {
  return number.whole + number.fraction + (number.exponent.empty() ? "" : "e" + power(number));
}

std::string latex_from_point(const Number& number) {
  return number.fraction + (number.exponent.empty() ? "" : "\\times 10^{" + power(number) + "}");
}

std::string latex_phantom(const std::string& text) {
  return text.empty() ? "" : "\\phantom{" + text + "}";
}

}  // namespace shoal::analysis
