#pragma once

#include <memory>
#include <string>

#include "shoal/core/csv_table.hpp"
#include "shoal/formations/obstacle.hpp"

namespace shoal::analysis {

/// The obstacle of a row with the columns cx, cy, b, psi and the named ones for the shape and for
/// the first size, of which each shape reads what it has options for. Throws InputError that names
/// the line.
std::unique_ptr<formations::Obstacle> obstacle_of(const CsvTable& table, std::size_t row,
                                                  const std::string& shape_column,
                                                  const std::string& size_column);

std::string shape_meaning();
inline constexpr const char* size_meaning = "m, radius, or half of the size along psi";
inline constexpr const char* width_meaning =
    "m, half of the size across, of shapes that have a width";
inline constexpr const char* angle_meaning = "rad, from x towards y, of shapes that have one";

}  // namespace shoal::analysis
