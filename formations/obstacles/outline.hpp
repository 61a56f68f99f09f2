#pragma once

#include <Eigen/Core>
#include <vector>

#include "shoal/formations/obstacle.hpp"

namespace shoal::formations {

/// The edge of an obstacle as a polygon, as seen from its centre, counter-clockwise; no point of
/// the edge is farther from it than a thousandth of the obstacle's size.
///
/// Of any shape of which every point of the edge is seen from the centre.
std::vector<Eigen::Vector2d> outline(const Obstacle& obstacle);

}  // namespace shoal::formations
