#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal::analysis {

/// What the designs that draw their cells have in common.

/// Throws InputError if there is no factor to draw, or if that many cells do not fit into memory.
void require_drawable(std::span<const int> levels, double cells, const Origin& origin);

/// What is wrong with a number that is no power of two: the points of Sobol' sequence are balanced
/// after 2^m of them only (Owen 2020, On dropping the first Sobol' point).
std::optional<std::string> power_of_two_complaint(const std::string& option, std::int64_t n);

/// The first points of Sobol' sequence, points x dimensions, in [0, 1), the origin among them.
///
/// Randomised by a digital shift (L'Ecuyer and Lemieux 2002, sec. 2.9) that is a pure function of
/// the seed and the dimension: balanced as the sequence is, and each point uniform by itself.
Eigen::MatrixXd sobol_points(Eigen::Index points, Eigen::Index dimensions, std::uint64_t seed,
                             const Origin& origin);

/// 0 to n - 1 in random order (Durstenfeld 1964); `uniform(i)` draws the i-th number of [0, 1).
template <class Uniform>
std::vector<Eigen::Index> shuffled(Eigen::Index n, const Uniform& uniform) {
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < n; ++i) {
    order.push_back(i);
    const auto other = static_cast<std::size_t>(uniform(i) * static_cast<double>(i + 1));
    std::swap(order.back(), order[other]);
  }
  return order;
}

}  // namespace shoal::analysis
