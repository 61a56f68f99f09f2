#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {
namespace {

struct MeanAndRange final : Statistic {
  std::string note() const override { return "Mean, least and greatest."; }

  Estimate of(const std::vector<double>& values) const override {
    Estimate cell = mean_of(values);
    const statistics::Summary summary = statistics::summarise(values);
    cell.uncertainty = Between{summary.least, summary.greatest};
    return cell;
  }

  static void declare(Options<MeanAndRange>&) {}
};

const Register<Statistic, MeanAndRange> registered{
    "mean [min, max]", "mean, least and greatest: the envelope of the trials"};

}  // namespace
}  // namespace shoal::analysis
