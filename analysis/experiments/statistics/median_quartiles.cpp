#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {
namespace {

struct MedianAndQuartiles final : Statistic {
  std::string note() const override { return "Median and quartiles."; }

  Estimate of(const std::vector<double>& values) const override {
    Estimate cell = mean_of(values);
    const statistics::Summary summary = statistics::summarise(values);
    cell.value = summary.median;
    cell.uncertainty = Between{summary.q1, summary.q3};
    return cell;
  }

  static void declare(Options<MedianAndQuartiles>&) {}
};

const Register<Statistic, MedianAndQuartiles> registered{"median [q1, q3]", "median and quartiles"};

}  // namespace
}  // namespace shoal::analysis
