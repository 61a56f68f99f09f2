#include "shoal/analysis/experiments/results/cells.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

/// `m_per_wh` of `m/Wh`, with another word for the stroke.
std::string unit_in_names(const std::string& unit, const std::string& per = "_per_") {
  std::string text;
  for (const char c : unit) {
    if (c == '/') {
      text += per;
    } else if (c == '%') {
      text += "percent";
    } else {
      text += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return text;
}

}  // namespace

std::string note_on_events() {
  return "Times to an event are restricted to the time that trials were watched, at which those "
         "count that never saw it: a restricted mean. Log-rank tests compare the events "
         "themselves, as if seeds were not shared.";
}

Cell cell_of(const Sample& sample, const Statistic& statistic) {
  if (sample.values.empty()) return Missing{sample.failed, sample.not_run};
  Estimate estimate = statistic.of(sample.restricted(sample.horizon()));
  estimate.failed = sample.failed;
  estimate.not_run = sample.not_run;
  if (statistic.is_of_values()) estimate.reached = sample.reached_count();
  return estimate;
}

std::string heading_of(const Quantity& quantity) {
  std::string name = quantity.name;
  for (const std::string& unit :
       {unit_in_names(quantity.unit), unit_in_names(quantity.unit, "_")}) {
    const std::string ending = "_" + unit;
    if (unit.empty() || !name.ends_with(ending)) continue;
    name.resize(name.size() - ending.size());
    break;
  }
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string name_with_unit(const std::string& name, const std::string& unit) {
  if (unit.empty() || name.ends_with("_" + unit_in_names(unit, "_"))) return name;
  const std::string ending = "_" + unit_in_names(unit);
  return name.ends_with(ending) ? name : name + ending;
}

std::vector<Cell> label_cells(const std::vector<std::string>& labels) {
  std::vector<Cell> numbers;
  for (const std::string& label : labels) {
    const std::optional<double> number = parsed_number(label);
    if (label == not_applied || label.empty()) {
      numbers.emplace_back(Missing{});
    } else if (number) {
      numbers.emplace_back(Estimate{.value = *number, .digits = Digits::significant(9)});
    } else {
      return {labels.begin(), labels.end()};
    }
  }
  return numbers;
}

}  // namespace shoal::analysis
