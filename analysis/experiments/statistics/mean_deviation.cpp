#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {
namespace {

struct MeanAndDeviation final : Statistic {
  std::string note() const override { return "Mean and standard deviation."; }

  Estimate of(const std::vector<double>& values) const override {
    Estimate cell = mean_of(values);
    const statistics::Summary summary = statistics::summarise(values);
    if (summary.n > 1) cell.uncertainty = Deviation{summary.sd};
    return cell;
  }

  static void declare(Options<MeanAndDeviation>&) {}
};

const Register<Statistic, MeanAndDeviation> registered{"mean +- sd", "mean and standard deviation"};

}  // namespace
}  // namespace shoal::analysis
