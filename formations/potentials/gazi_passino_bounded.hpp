#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// Linear attraction, bounded repulsion: the force on the distance is f'(r) = r (a - b e^(-r^2/c)).
///
/// Gazi and Passino 2002. It vanishes at r = s for
/// c = s^2 / ln(b/a), which needs b > a. The repulsion b r e^(-r^2/c) is at most b sqrt(c/2e), and
/// nothing at r = 0: vehicles can pass through one another. The potential is the integral,
/// f(r) = a r^2 / 2 + (b c / 2) e^(-r^2/c), in metres.
struct GaziPassinoBounded {
  double attraction_per_m = 0.0017;
  double repulsion_per_m = 0.034;

  template <class T>
  T operator()(const T& r, double s) const {
    using std::exp;
    const double c = s * s / std::log(repulsion_per_m / attraction_per_m);
    return 0.5 * attraction_per_m * r * r + 0.5 * repulsion_per_m * c * exp(r * r / -c);
  }

  std::optional<std::string> complaint() const {
    if (repulsion_per_m > attraction_per_m) return std::nullopt;
    return "repulsion_per_m must be above attraction_per_m, or vehicles attract at any distance";
  }

  static void declare(Options<GaziPassinoBounded>& o) {
    using G = GaziPassinoBounded;
    o.number("attraction_per_m", &G::attraction_per_m, "1/m", above(0), "a: pull per metre");
    o.number("repulsion_per_m", &G::repulsion_per_m, "1/m", above(0),
             "b: push per metre at small distances, above the attraction");
  }
};

}  // namespace shoal::formations
