#include "shoal/analysis/experiments/evaluations/obstacle_row.hpp"

#include <map>

#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

const RegistryBase& shapes() {
  return Registry<formations::Obstacle>::instance();
}

/// The one shape of that name, or whose name alone begins like that.
std::string shape_called(const std::string& text, const Origin& origin, const std::string& column) {
  if (shapes().find(text) != nullptr) return text;
  std::vector<std::string> meant;
  for (const std::string& name : shapes().names()) {
    if (!text.empty() && name.starts_with(text)) meant.push_back(name);
  }
  if (meant.size() == 1) return meant.front();
  throw InputError(origin, column + " is \"" + text + "\", which is no shape" +
                               suggestion(text, shapes().names()));
}

}  // namespace

std::unique_ptr<formations::Obstacle> obstacle_of(const CsvTable& table, std::size_t row,
                                                  const std::string& shape_column,
                                                  const std::string& size_column) {
  const Origin origin = table.origin(row);
  const std::string shape = shape_called(table.text(row, shape_column), origin, shape_column);
  constexpr const char* angle = "psi";
  const std::map<std::string, std::string> columns{
      {"x_m", "cx"},         {"y_m", "cy"},          {"radius_m", size_column},
      {"half_width_m", "b"}, {"heading_deg", angle}, {"half_length_m", size_column}};
  Setting options;
  options.origin = origin;
  for (const Option& option : shapes().find(shape)->schema().options) {
    const auto found = columns.find(option.name);
    if (found == columns.end()) continue;
    const std::string& column = found->second;
    const double number =
        option.range.contains(0.0) ? table.number(row, column) : positive(table, row, column);
    options.at_or_new(option.name).value = column == angle ? to_compass_deg(number) : number;
  }
  return Registry<formations::Obstacle>::instance().make(shape, options, shape_column);
}

std::string shape_meaning() {
  return "one of " + listed(shapes().names()) + ", or how its name begins";
}

}  // namespace shoal::analysis
