#include "shoal/analysis/experiments/results/cells.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/summary.hpp"
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

std::string note_on(Statistic statistic) {
  switch (statistic) {
    case Statistic::mean:
      return "Means.";
    case Statistic::mean_ci:
      return "Mean and half the 95 % confidence interval (Student).";
    case Statistic::mean_sd:
      return "Mean and standard deviation.";
    case Statistic::mean_range:
      return "Mean, least and greatest.";
    case Statistic::mean_bca:
      return "Mean and 95 % confidence interval (BCa bootstrap).";
    case Statistic::median_quartiles:
      return "Median and quartiles.";
    case Statistic::count:
      return "Number of values.";
  }
  return "";
}

std::string note_on_events() {
  return "Times to an event are restricted to the time that trials were watched, at which those "
         "count that never saw it: a restricted mean. Log-rank tests compare the events "
         "themselves, as if seeds were not shared.";
}

Cell cell_of(const Sample& sample, Statistic statistic) {
  if (sample.values.empty()) return Missing{sample.failed, sample.not_run};
  Cell cell = cell_of(sample.restricted(sample.horizon()), statistic);
  auto& estimate = std::get<Estimate>(cell);
  estimate.failed = sample.failed;
  estimate.not_run = sample.not_run;
  if (statistic != Statistic::count) estimate.reached = sample.reached_count();
  return cell;
}

Cell cell_of(const std::vector<double>& values, Statistic statistic) {
  if (values.empty()) return Missing{};
  const statistics::Summary summary = statistics::summarise(values);
  const std::optional<double> error = statistics::standard_error(values);
  Estimate cell{.value = summary.mean, .n = summary.n, .each = values};
  // Without a scatter there is no uncertainty to take the digits from.
  cell.digits = error ? decimals_for(*error) : Digits::significant(4);
  switch (statistic) {
    case Statistic::mean:
      break;
    case Statistic::mean_ci:
      if (const auto interval = statistics::t_interval(values, confidence)) {
        const double half = (interval->high - interval->low) / 2.0;
        cell.uncertainty = PlusMinus{half};
        cell.digits = decimals_for(half);
      }
      break;
    case Statistic::mean_sd:
      if (summary.n > 1) cell.uncertainty = Deviation{summary.sd};
      break;
    case Statistic::mean_range:
      cell.uncertainty = Between{summary.least, summary.greatest};
      break;
    case Statistic::mean_bca:
      if (const auto interval = statistics::bca_interval_of_mean(values, confidence)) {
        cell.uncertainty = Between{interval->low, interval->high};
      }
      break;
    case Statistic::median_quartiles:
      cell.value = summary.median;
      cell.uncertainty = Between{summary.q1, summary.q3};
      break;
    case Statistic::count:
      cell.value = summary.n;
      cell.n = 0;
      cell.each.clear();
      cell.digits = Digits::decimals(0);
      break;
  }
  return cell;
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
