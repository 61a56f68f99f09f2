#include "shoal/analysis/experiments/results/sensitivity_analysis.hpp"
#include "shoal/analysis/statistics/sensitivity/morris_effects.hpp"

namespace shoal::analysis {
namespace {

/// Their means over replications; missing where that of any replication is.
std::vector<std::optional<double>> means_of(const AnswersBySeed& answers) {
  std::vector<std::optional<double>> means = answers.front();
  for (std::size_t k = 1; k < answers.size(); ++k) {
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
      const std::optional<double>& y = answers[k][cell];
      means[cell] = means[cell] && y ? std::optional(*means[cell] + *y) : std::nullopt;
    }
  }
  for (auto& mean : means) {
    if (mean) *mean /= static_cast<double>(answers.size());
  }
  return means;
}

/// Elementary effects of the mean over replications.
struct EffectTable final : SensitivityAnalysis {
  std::vector<Table> tables(const AnalysedGroup& group) const override {
    Table table{
        group.request().name,
        group.request().caption,
        {{.header = "measure"},
         {.header = "factor"},
         {.header = "mu"},
         {.header = "mu*", .name = "mu_star"},
         {.header = "sigma"}},
        {},
        {"Elementary effects of a change by the whole range of the factor; mu* with its 95 % "
         "bootstrap interval."}};
    for (const std::string& measure : group.request().measures) {
      const MorrisEffects effects = morris_effects(
          group.planned().design(), means_of(group.answers(measure)), AnalysedGroup::resampling());
      for (std::size_t f = 0; f < effects.factors.size(); ++f) {
        const MorrisEffect& effect = effects.factors[f];
        std::vector<Cell> cells = group.row(measure, f);
        cells.emplace_back(Estimate{.value = effect.mu, .digits = Digits::significant(3)});
        cells.push_back(cell_of(effect.mu_star));
        cells.push_back(
            effect.sigma ? Cell(Estimate{.value = *effect.sigma, .digits = Digits::significant(3)})
                         : Cell(Missing{}));
        table.rows.push_back(std::move(cells));
      }
      table.notes.push_back(note_on_samples(measure, effects.trajectories, effects.left_out,
                                            "trajectories", effects.undefined));
    }
    return {table};
  }

  static void declare(Options<EffectTable>&) {}
};

const Register<SensitivityAnalysis, EffectTable> registered{"morris",
                                                            "elementary effects (Morris 1991)"};

}  // namespace
}  // namespace shoal::analysis
