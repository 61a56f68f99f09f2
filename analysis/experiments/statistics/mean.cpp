#include "shoal/analysis/experiments/statistic.hpp"

namespace shoal::analysis {
namespace {

struct Mean final : Statistic {
  std::string note() const override { return "Means."; }

  Estimate of(const std::vector<double>& values) const override { return mean_of(values); }

  static void declare(Options<Mean>&) {}
};

const Register<Statistic, Mean> registered{"mean", "the mean"};

}  // namespace
}  // namespace shoal::analysis
