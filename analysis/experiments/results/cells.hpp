#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// What the cells of a table hold: the statistic over a sample; missing where it has no value.
/// Times of events are restricted to the sample's horizon.
Cell cell_of(const Sample& sample, const Statistic& statistic);

/// What a note says of times to an event that some trials never saw.
std::string note_on_events();

/// `energy mean` of energy_mean_wh: a name without its unit, as words.
std::string heading_of(const Quantity& quantity);

/// `period_s` of a period in seconds: a name that ends with its unit.
std::string name_with_unit(const std::string& name, const std::string& unit);

/// A label as a number where all labels of the dimension are numbers, or as a text.
std::vector<Cell> label_cells(const std::vector<std::string>& labels);

}  // namespace shoal::analysis
