#include "shoal/analysis/experiments/statistic.hpp"

namespace shoal::analysis {
namespace {

struct MeanAndInterval final : Statistic {
  std::string note() const override {
    return "Mean and half the 95 % confidence interval (Student).";
  }

  Estimate of(const std::vector<double>& values) const override {
    return mean_with_interval(values);
  }

  static void declare(Options<MeanAndInterval>&) {}
};

const Register<Statistic, MeanAndInterval> registered{
    "mean +- ci95", "mean, and half the width of Student's 95 % confidence interval"};

}  // namespace
}  // namespace shoal::analysis
