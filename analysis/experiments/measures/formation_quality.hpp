#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>

#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

/// How well vehicles keep a formation: the mean distance (m) between them and the slots of a
/// (padded) plan that is laid onto them, each with a slot of its own. Rypkema 2015, sec. 4.3.
///
/// Zero for the perfect formation, unbounded above; reflected formations do not count as the same.
class FormationQuality {
 public:
  struct Value {
    double quality_m = 0.0;
    /// No way of laying the plan onto the vehicles has a lower mean distance. Nothing where the
    /// recipe does not tell.
    std::optional<double> lower_bound_m;
  };

  /// One way to find how the plan is laid.
  class Recipe {
   public:
    virtual ~Recipe() = default;
    virtual Value of(std::span<const Eigen::Vector2d> positions) = 0;
    virtual std::span<const int> slot_of_position() const = 0;
  };

  /// The plan needs as many slots as there are vehicles, or more.
  FormationQuality(const formations::Plan& plan, const scenarios::QualityOptions& options);

  /// Positions in metres, finite, at least one. What was measured before makes it quicker, and
  /// changes it within the tolerance, or down to the lower bound, only.
  Value of(std::span<const Eigen::Vector2d> positions) { return recipe_->of(positions); }

  /// The slot of each position, as the last of() assigned them.
  std::span<const int> slot_of_position() const { return recipe_->slot_of_position(); }

 private:
  std::unique_ptr<Recipe> recipe_;
};

}  // namespace shoal::analysis
