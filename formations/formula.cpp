#include "shoal/formations/formula.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "shoal/core/text.hpp"
#include "shoal/formations/formulas/derivatives.hpp"

namespace shoal::formations {
namespace {

std::array<double, 3> parts(const RadialValue& f) {
  return {f.value, f.slope, f.curvature};
}

constexpr std::array<const char*, 3> part_names{"it", "its first derivative",
                                                "its second derivative"};

std::string spelled(double x) {
  return std::isnan(x) ? "not a number" : std::isinf(x) ? "infinite" : shortest(x);
}

std::string six_digits(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 6).ptr};
}

/// Evenly on a logarithmic scale, finer around the separation, and at whole metres, where people
/// put the edges of their cases.
std::vector<double> sampled_distances(double from, double to, double s) {
  std::vector<double> distances{from, to, s};
  constexpr int even = 4000;
  for (int i = 1; i < even; ++i) distances.push_back(from * std::pow(to / from, double(i) / even));
  for (int i = 1; i <= 100; ++i) {
    distances.push_back(s * (1.0 - 1e-3 * i));
    distances.push_back(s * (1.0 + 1e-3 * i));
  }
  for (int metre = 1; metre <= 5000; ++metre) distances.push_back(metre);
  std::erase_if(distances, [&](double r) { return !(r >= from && r <= to); });
  std::ranges::sort(distances);
  return distances;
}

}  // namespace

Formula::Formula(std::string_view text, const NamedNumbers& parameters) {
  const formulas::Tree tree = formulas::parsed(text, parameters);
  if (std::ranges::none_of(tree.nodes, [](const formulas::Tree::Node& n) {
        return n.operation == formulas::Operation::distance;
      })) {
    throw InputError("it does not depend on the distance r");
  }
  program_ = formulas::differentiated(tree);
}

void Formula::prepare(double s) {
  prepared_ = program_.at(s);
  prepared_s_ = s;
}

std::optional<std::string> Formula::trouble(double from_m, double to_m, double s) const {
  const auto found = [&](std::size_t part, double r, const std::string& is) {
    return std::string(part_names[part]) + " is " + is + " at r = " + six_digits(r) +
           " m for s = " + shortest(s) + " m";
  };
  // Where the sign changes between two samples lies a zero, or a jump, or a pole: only that grows.
  const auto pole = [&](std::size_t part, double low, double high) -> std::optional<double> {
    const auto f = [&](double r) { return parts(derivatives(r, s))[part]; };
    double at_low = f(low);
    double at_high = f(high);
    const double large = 1e6 * std::max(std::abs(at_low), std::abs(at_high));
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      const double at_middle = f(middle);
      if (!std::isfinite(at_middle)) return middle;
      ((at_middle < 0.0) == (at_low < 0.0) ? low : high) = middle;
      ((at_middle < 0.0) == (at_low < 0.0) ? at_low : at_high) = at_middle;
    }
    if (std::max(std::abs(at_low), std::abs(at_high)) > large) return low;
    return std::nullopt;
  };

  std::array<double, 3> before{};
  double r_before = 0.0;
  for (const double r : sampled_distances(from_m, to_m, s)) {
    const std::array<double, 3> here = parts(derivatives(r, s));
    for (std::size_t k = 0; k < here.size(); ++k) {
      if (!std::isfinite(here[k])) return found(k, r, spelled(here[k]));
    }
    for (std::size_t k = 0; k < here.size() && r_before > 0.0; ++k) {
      if (here[k] * before[k] >= 0.0) continue;
      if (const auto at = pole(k, r_before, r)) return found(k, *at, "not finite");
    }
    before = here;
    r_before = r;
  }
  return std::nullopt;
}

}  // namespace shoal::formations
