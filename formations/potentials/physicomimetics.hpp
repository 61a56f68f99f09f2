#pragma once

#include <cmath>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// The integral of x^-k from 1 to u, also where k is 1 or so near that (u^(1-k) - 1) / (1-k) would
/// be lost to rounding.
template <class T>
T integrated_power(const T& u, double k) {
  using std::log;
  using std::pow;
  const double e = 1.0 - k;
  if (std::abs(e) > 1e-4) return (pow(u, e) - 1.0) / e;
  const T x = log(u);
  const T y = e * x;
  return x * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0))));
}

/// Generalised gravity: a force of size G / r^p that repels inside the switch radius s and attracts
/// outside. Spears et al. 2004, 2005; here G = force s^p, so that `force` is its size at s.
///
/// As published the force jumps at s, where the potential would have a kink at its very minimum.
/// Within s (1 +- band) it is therefore multiplied by (r/s - 1) / band; for a band towards zero
/// this is the published law. With u = r/s and P_k(u) the integral of x^-k from 1 to u:
///   inside the band  f = force s / band (P_{p-1}(u) - P_p(u)),
///   outside of it    f = f(edge) +- force s (P_p(u) - P_p(edge)), in metres.
/// The rest of the source is in the behaviours, for any potential: the cut-off at 1.5 s (1.7 s for
/// squares) is their contact_rangeout_m, squares of two kinds of vehicles their `lattice`, and F =
/// m a with friction the behaviour pair_forces. The bound on the force, which keeps simulated
/// particles from flying apart within a time step, is the envelope there; attraction_repulsion
/// needs none.
struct Physicomimetics {
  double force = 1.0;
  double power = 2.0;
  double band = 0.02;

  template <class T>
  T operator()(const T& r, double s) const {
    const T u = r / s;
    if (u < 1.0 - band) return beyond(u, 1.0 - band, -force * s, s);
    if (u > 1.0 + band) return beyond(u, 1.0 + band, force * s, s);
    return near(u, s);
  }

  template <class T>
  T near(const T& u, double s) const {
    return force * s / band * (integrated_power(u, power - 1.0) - integrated_power(u, power));
  }
  template <class T>
  T beyond(const T& u, double edge, double factor, double s) const {
    return near(edge, s) + factor * (integrated_power(u, power) - integrated_power(edge, power));
  }

  static void declare(Options<Physicomimetics>& o) {
    using P = Physicomimetics;
    o.number("force", &P::force, "", above(0), "size of the force at the separation: G / s^p");
    o.number("power", &P::power, "", in(-5, 5), "p: how fast the force fades, as r^-p");
    o.number("band", &P::band, "", {.low = 0.0, .high = 0.5, .low_included = false},
             "share of the separation within which the force passes linearly through zero");
  }
};

}  // namespace shoal::formations
