#include "shoal/solvers/matching/slot_lattice.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shoal/core/interruption.hpp"
#include "shoal/core/transform.hpp"

namespace shoal::solvers {
namespace {

constexpr double same_place_ratio = 1e-12;
constexpr double same_ratio = 1e-9;
constexpr double parallel = 1e-3;  // sine of the angle between two vectors
constexpr double farthest_cell = 1e6;

bool permuted(std::span<const Eigen::Vector2d> slots, double angle, double same_m) {
  const Transform2 turn = Transform2::from_angle(angle, Eigen::Vector2d::Zero());
  return std::ranges::all_of(slots, [&](const Eigen::Vector2d& slot) {
    check_interruption();
    const Eigen::Vector2d turned = turn * slot;
    return std::ranges::any_of(slots, [&](const Eigen::Vector2d& other) {
      return (turned - other).squaredNorm() <= same_m * same_m;
    });
  });
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The shortest vector between two slots that `counts`; zero if there is none.
template <class Counts>
Eigen::Vector2d shortest(std::span<const Eigen::Vector2d> slots, Counts counts) {
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector2d found = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    check_interruption();
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector2d v = slots[i] - slots[j];
      // Rounding must not decide which of several equally short ones is taken.
      if (v.squaredNorm() < least * (1.0 - same_ratio) && counts(v)) {
        least = v.squaredNorm();
        found = v;
      }
    }
  }
  return found;
}

}  // namespace

int rotational_symmetry(std::span<const Eigen::Vector2d> slots) {
  double extent_m = 0.0;
  for (const Eigen::Vector2d& slot : slots) extent_m = std::max(extent_m, slot.norm());
  const auto count = static_cast<int>(slots.size());
  // All but one in the centre come in groups of k.
  for (int k = count; k > 1; --k) {
    if (count % k > 1) continue;
    if (permuted(slots, 2.0 * std::numbers::pi / k, same_place_ratio * extent_m)) return k;
  }
  return 1;
}

std::optional<SlotLattice> SlotLattice::of(std::span<const Eigen::Vector2d> slots) {
  SlotLattice lattice;
  lattice.a = shortest(slots, [](const Eigen::Vector2d& v) { return v.squaredNorm() > 0.0; });
  lattice.b = shortest(slots, [&](const Eigen::Vector2d& v) {
    return std::abs(cross(lattice.a, v)) > parallel * lattice.a.norm() * v.norm();
  });
  if (lattice.b.isZero(0.0)) return std::nullopt;
  if (cross(lattice.a, lattice.b) < 0.0) lattice.b = -lattice.b;
  Eigen::Matrix2d basis;
  basis << lattice.a, lattice.b;
  const Eigen::Matrix2d to_cells = basis.inverse();
  for (const Eigen::Vector2d& slot : slots) {
    const Eigen::Array2d cells = to_cells * (slot - slots[0]);
    if ((cells.abs() > farthest_cell).any() || ((cells - cells.round()).abs() > same_ratio).any()) {
      return std::nullopt;
    }
  }
  const double squared = lattice.a.squaredNorm();
  const auto is = [squared](double x, double y) { return std::abs(x - y) <= same_ratio * squared; };
  if (is(lattice.b.squaredNorm(), squared)) {
    const double dot = std::abs(lattice.a.dot(lattice.b));
    lattice.symmetry = is(dot, 0.0) ? 4 : is(dot, 0.5 * squared) ? 6 : 2;
  }
  return lattice;
}

Eigen::Vector2i SlotLattice::coordinates(const Eigen::Vector2d& v) const {
  const double area = cross(a, b);
  return {static_cast<int>(std::lround(cross(v, b) / area)),
          static_cast<int>(std::lround(cross(a, v) / area))};
}

}  // namespace shoal::solvers
