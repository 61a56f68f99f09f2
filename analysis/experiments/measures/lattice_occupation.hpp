#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace shoal::analysis {

/// The distance (m) between the two nearest of these points; infinity for fewer than two.
double least_spacing_m(std::span<const Eigen::Vector2d> points);

/// Into how many groups points fall if those within reach of one another belong together.
int groups_within(std::span<const Eigen::Vector2d> points, double reach_m);

/// Holes of a lattice of which some slots are taken: groups of empty slots, next to one another,
/// that taken slots close in. A gap that is open to the outside is none: slots at the rim of the
/// lattice, with fewer neighbours than others have, are outside if they are empty.
int holes(std::span<const Eigen::Vector2d> slots, const std::vector<bool>& taken);

/// How many of the taken slots lie outside the outline of a plan, laid where it covers most of
/// them: moved by lattice vectors and turned by multiples of 1/symmetry of a circle.
///
/// The plan's slots are some of the lattice's, in its frame; no two of them coincide.
int outside_outline(std::span<const Eigen::Vector2d> taken, std::span<const Eigen::Vector2d> plan,
                    int symmetry);

}  // namespace shoal::analysis
