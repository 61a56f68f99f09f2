#pragma once

#include "shoal/core/registry.hpp"

namespace shoal::solvers {

/// A loss and its first two derivatives with respect to the squared residual.
struct LossValue {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

/// What a residual r costs, as a function of r^2; r^2 itself near zero, so that losses may be
/// exchanged without a change of scale. Robust losses grow more slowly and let outliers go.
class Loss {
 public:
  static constexpr const char* family = "loss";
  static constexpr const char* family_meaning = "what a residual costs";

  virtual ~Loss() = default;
  virtual LossValue at(double squared) const = 0;

  /// True for r^2 itself, for which there are closed forms.
  virtual bool is_square() const { return false; }
};

}  // namespace shoal::solvers
