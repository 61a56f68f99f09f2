#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/statistics/intervals.hpp"

namespace shoal::analysis {
namespace {

struct MeanAndBootstrap final : Statistic {
  std::string note() const override { return "Mean and 95 % confidence interval (BCa bootstrap)."; }

  Estimate of(const std::vector<double>& values) const override {
    Estimate cell = mean_of(values);
    if (const auto interval = statistics::bca_interval_of_mean(values, confidence)) {
      cell.uncertainty = Between{interval->low, interval->high};
    }
    return cell;
  }

  static void declare(Options<MeanAndBootstrap>&) {}
};

const Register<Statistic, MeanAndBootstrap> registered{
    "mean [bca95]", "mean, and the 95 % interval of the bias-corrected and accelerated bootstrap"};

}  // namespace
}  // namespace shoal::analysis
