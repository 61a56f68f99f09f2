#pragma once

#include <memory>
#include <optional>
#include <string>

#include "shoal/core/registry.hpp"
#include "shoal/formations/plane_value.hpp"
#include "shoal/solvers/taylor.hpp"

namespace shoal::formations {

/// A potential between two vehicles as a function of their distance r (m, above 0), lowest at the
/// separation s (m). A law that is published as a force is registered as its integral.
class Potential {
 public:
  static constexpr const char* family = "potential";
  static constexpr const char* family_meaning = "pair potential of two vehicles";

  virtual ~Potential() = default;
  virtual double value(double r, double s) const = 0;
  virtual RadialValue derivatives(double r, double s) const = 0;

  /// What is wrong with this potential at this separation, or nothing. Asked before it is used.
  virtual std::optional<std::string> complaint(double separation_m) const {
    (void)separation_m;
    return std::nullopt;
  }

  /// Called once, before it is shared, with the separation to come: it may compute ahead.
  virtual void prepare(double separation_m) { (void)separation_m; }
};

/// Makes a Potential of a struct with `template <class T> T operator()(const T& r, double s)
/// const`; the derivatives are exact.
template <class Law>
class PotentialOf final : public Potential {
 public:
  explicit PotentialOf(const Law& law) : law_(law) {}

  double value(double r, double s) const override { return law_(r, s); }

  RadialValue derivatives(double r, double s) const override {
    const auto f = solvers::Taylor<1>(law_(solvers::Taylor<1>::unknown(r, 0), s));
    return {f.value, f.gradient[0], f.hessian(0, 0)};
  }

 private:
  Law law_;
};

/// Registers a potential law: `const RegisterPotential<LennardJones> registered{"lennard_jones",
/// "..."};`
template <class Law>
struct RegisterPotential : Register<Potential, Law> {
  RegisterPotential(std::string name, std::string summary)
      : Register<Potential, Law>(std::move(name), std::move(summary), [](const Law& law) {
          return std::make_unique<PotentialOf<Law>>(law);
        }) {}
};

}  // namespace shoal::formations
