#pragma once

// What behaviours share that fit the plan to what was heard.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shoal/core/error.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/formations/weighting.hpp"

namespace shoal::formations {

/// How much something heard counts.
struct Weights {
  double contact_rangeout_m;  ///< what is further away is left out by the behaviour
  Weighting weighting;
  double age_scale_s;

  /// Of a behaviour with options of these names.
  template <class Fitting>
  static Weights of(const Fitting& options) {
    return {options.contact_rangeout_m, options.weighting, options.age_scale_s};
  }

  /// `place`: metres, own frame.
  bool in_range(const Eigen::Vector2d& place) const {
    const double squared = place.squaredNorm();
    // Most are well inside, and spare the root.
    return squared <= contact_rangeout_m * contact_rangeout_m ||
           std::sqrt(squared) <= contact_rangeout_m;
  }

  /// From 0 to 1, for a place in range.
  double weight(const Eigen::Vector2d& place, double age_s) const {
    switch (weighting) {
      case Weighting::distance:
        return 1.0 - place.norm() / contact_rangeout_m;
      case Weighting::ping_age:
        return std::max(0.0, 1.0 - age_s / age_scale_s);
      case Weighting::none:
        break;
    }
    return 1.0;
  }
};

/// Declares the members `weighting` and `age_scale_s` of the options of a behaviour.
template <class Fitting>
void declare_weighting(Options<Fitting>& o, const std::string& meaning) {
  o.word("weighting", &Fitting::weighting,
         {{"none", Weighting::none},
          {"distance", Weighting::distance},
          {"ping_age", Weighting::ping_age}},
         meaning);
  o.number("age_scale_s", &Fitting::age_scale_s, "s", above(0),
           "age at which the weight \"ping_age\" has fallen to zero");
}

/// Throws InputError if there is something against what was chosen for the option `name`, given
/// what was chosen for an option `beside` it in the same table. It points where one of them
/// was written.
inline void require_nothing_against(const std::optional<std::string>& why, std::string_view name,
                                    const ChoiceSetting& chosen, const ChoiceSetting& beside) {
  if (!why) return;
  const bool written = !chosen.path.empty();
  std::string key = written ? chosen.path : beside.path;
  if (!written) key = key.substr(0, key.rfind('.') + 1) + std::string(name);
  throw InputError(written ? chosen.origin : beside.origin, key + ": " + chosen.kind + " " + *why);
}

}  // namespace shoal::formations
