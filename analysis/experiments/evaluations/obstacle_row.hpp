#pragma once

#include <memory>
#include <string>

#include "shoal/core/csv_table.hpp"
#include "shoal/formations/obstacle.hpp"

namespace shoal::analysis {

/// The obstacle of a row with the columns cx, cy, b, psi and the named ones for the shape (circle,
/// rectangle or rect, ellipse) and for the first size. Throws InputError that names the line.
std::unique_ptr<formations::Obstacle> obstacle_of(const CsvTable& table, std::size_t row,
                                                  const std::string& shape_column,
                                                  const std::string& size_column);

inline constexpr const char* shape_meaning = "circle, rectangle (or rect) or ellipse";
inline constexpr const char* size_meaning = "m, radius, or half of the size along psi";
inline constexpr const char* width_meaning = "m, half of the size across; not read for circles";
inline constexpr const char* angle_meaning = "rad, from x towards y; not read for circles";

}  // namespace shoal::analysis
