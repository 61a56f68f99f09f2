#include "shoal/analysis/statistics/simulated_power.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr int simulated = 4000;

/// The k-th sample of standard normal differences; its first n are the sample of n.
const double* normal_sample(int k) {
  static const std::vector<double> all = [] {
    const RandomStreams random(1908);
    std::vector<double> numbers;
    for (std::uint32_t sample = 0; sample < simulated; ++sample) {
      for (std::uint64_t i = 0; i < most_simulated_differences; i += 2) {
        const auto [a, b] = random.normal(Purpose::sign_flip, sample, i);
        numbers.push_back(a);
        numbers.push_back(b);
      }
    }
    return numbers;
  }();
  return all.data() + static_cast<std::ptrdiff_t>(k) * most_simulated_differences;
}

}  // namespace

double simulated_power(int n, double effect, const Rejects& rejects) {
  int rejected = 0;
  for (int k = 0; k < simulated; ++k) {
    std::vector<double> sample(normal_sample(k), normal_sample(k) + n);
    // Without scatter, all differences are the same.
    for (double& x : sample) x = std::isinf(effect) ? std::copysign(1.0, effect) : x + effect;
    rejected += rejects(std::move(sample)) ? 1 : 0;
  }
  return static_cast<double>(rejected) / simulated;
}

}  // namespace shoal::analysis::statistics
