#include "shoal/analysis/experiments/cf_unit.hpp"

#include "shoal/core/text.hpp"

namespace shoal::analysis {

std::string cf_unit(const std::string& unit) {
  if (unit.empty()) return "1";
  if (unit == "m/Wh") return "m W-1 h-1";  // in UDUNITS a stroke takes back the watts alone
  std::string text;
  for (const std::string_view part : split(unit, '/')) {
    if (!text.empty()) text += '/';
    text += part == "deg" ? "degree" : part == "Wh" ? "W h" : std::string(part);
  }
  return text;
}

}  // namespace shoal::analysis
