#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shoal/core/error.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::formations {

/// The geometry that a swarm should take: named slots, metres, in the frame of the plan.
///
/// Position and orientation of that frame mean nothing (Rypkema 2015, sec. 3.3.2): every behaviour
/// is invariant to them.
class Plan {
 public:
  /// Throws InputError (with `origin`) for no slots, duplicate names, positions that are not finite
  /// or beyond 10,000 km, and slots closer than a millimetre to one another.
  Plan(std::vector<std::string> names, std::vector<Eigen::Vector2d> slots,
       const Origin& origin = {});

  int size() const { return static_cast<int>(slots_.size()); }
  const Eigen::Vector2d& slot(int index) const { return slots_[static_cast<std::size_t>(index)]; }
  std::span<const Eigen::Vector2d> slots() const { return slots_; }
  const std::string& name(int index) const { return names_[static_cast<std::size_t>(index)]; }
  std::span<const std::string> names() const { return names_; }

  /// Throws InputError (with `origin`), naming the known slots, if there is none of that name.
  int index_of(std::string_view name, const Origin& origin = {}) const;

  /// The same plan moved so that the mean of its slots is the origin.
  Plan centred() const;

 private:
  std::vector<std::string> names_;
  std::vector<Eigen::Vector2d> slots_;
  std::vector<int> by_name_;  // indices of the slots, sorted by their names
};

/// The first two entries, by index, that have the same name; nothing if all differ.
std::optional<std::pair<int, int>> same_name(std::span<const std::string> names);

/// Two points, by index, closer than a millimetre to one another; nothing if there are none.
/// Points must be finite.
std::optional<std::pair<int, int>> same_place(std::span<const Eigen::Vector2d> points);

/// Lattice positions that padding adds to a plan on every side, at most.
inline constexpr int most_layers = 100;

/// A way to come by a plan: a lattice, letters, a file ...
class PlanSource {
 public:
  static constexpr const char* family = "plan";
  static constexpr const char* family_meaning = "the geometry the swarm should take";

  virtual ~PlanSource() = default;
  virtual Plan plan() const = 0;

  /// The plan with `layers` more lattice positions on every side, against which the quality of a
  /// formation is measured (Rypkema 2015, sec. 4.3). The plan itself where it is no lattice.
  virtual Plan padded(int layers) const {
    (void)layers;
    return plan();
  }
};

}  // namespace shoal::formations
