#include "shoal/analysis/experiments/statistic.hpp"

namespace shoal::analysis {
namespace {

struct PlainMean final : Statistic {
  std::string note() const override { return "Means."; }

  Estimate of(const std::vector<double>& values) const override { return mean_of(values); }

  static void declare(Options<PlainMean>&) {}
};

const Register<Statistic, PlainMean> registered{"mean", "the mean"};

}  // namespace
}  // namespace shoal::analysis
