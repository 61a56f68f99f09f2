#include "shoal/analysis/experiments/statistic.hpp"

namespace shoal::analysis {
namespace {

struct Count final : Statistic {
  std::string note() const override { return "Number of values."; }

  Estimate of(const std::vector<double>& values) const override {
    return {.value = static_cast<double>(values.size()), .digits = Digits::decimals(0)};
  }

  bool is_of_values() const override { return false; }

  static void declare(Options<Count>&) {}
};

const Register<Statistic, Count> registered{"n", "how many values there are"};

}  // namespace
}  // namespace shoal::analysis
