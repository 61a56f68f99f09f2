#include "shoal/analysis/experiments/results/sensitivity_analysis.hpp"

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"

namespace shoal::analysis {

Resampling AnalysedGroup::resampling() {
  return {.level = confidence};
}

std::vector<Cell> AnalysedGroup::row(const std::string& measure, std::size_t factor) const {
  return {heading_of(known_value(measure, request_.origin)), planned().axes()[factor].name()};
}

AnswersBySeed AnalysedGroup::answers(const std::string& measure) const {
  const Question question{measure, "", "", 0.0};
  AnswersBySeed answers(static_cast<std::size_t>(planned().replications()));
  for (int k = 0; k < planned().replications(); ++k) {
    for (std::size_t cell = 0; cell < planned().cells(); ++cell) {
      answers[static_cast<std::size_t>(k)].push_back(
          results_.answer(question, results_.list().index(group_, cell, k)).bounded());
    }
  }
  return answers;
}

Cell cell_of(const IndexEstimate& estimate) {
  Estimate cell{.value = estimate.value, .digits = Digits::decimals(3)};
  if (estimate.interval)
    cell.uncertainty = Between{estimate.interval->low, estimate.interval->high};
  return cell;
}

std::string note_on_samples(const std::string& measure, int count, int left_out,
                            const std::string& samples, const std::string& undefined) {
  std::string text = measure + ": " + std::to_string(count) + " " + samples;
  if (left_out > 0) {
    text += ", " + std::to_string(left_out) + " left out, of which some answer is missing";
  }
  return text + (undefined.empty() ? "." : "; no indices: " + undefined + ".");
}

}  // namespace shoal::analysis
