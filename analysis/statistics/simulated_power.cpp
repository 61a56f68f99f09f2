#include "shoal/analysis/statistics/simulated_power.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr int simulated = 4000;
constexpr int most_differences = 60;
constexpr double most_patterns = 256.0;

/// The k-th sample of standard normal differences; its first n are the sample of n.
const double* normal_sample(int k) {
  static const std::vector<double> all = [] {
    const RandomStreams random(1908);
    std::vector<double> numbers;
    for (std::uint32_t sample = 0; sample < simulated; ++sample) {
      for (std::uint64_t i = 0; i < most_differences; i += 2) {
        const auto [a, b] = random.normal(Purpose::sign_flip, sample, i);
        numbers.push_back(a);
        numbers.push_back(b);
      }
    }
    return numbers;
  }();
  return all.data() + static_cast<std::ptrdiff_t>(k) * most_differences;
}

/// Whether more than `most` subsets of ascending magnitudes have a sum of at most `limit`.
bool more_subsets(const std::vector<double>& magnitudes, std::size_t first, double limit, int most,
                  int& found) {
  for (std::size_t i = first; i < magnitudes.size() && magnitudes[i] <= limit; ++i) {
    if (++found > most) return true;
    if (more_subsets(magnitudes, i + 1, limit - magnitudes[i], most, found)) return true;
  }
  return false;
}

/// Of the 2^n patterns of signs, two times those count that turn terms of the lesser side's total
/// at most: the others bring the sum nearer to zero.
bool sign_flip_rejects(std::vector<double> differences, int most) {
  double above = 0.0, below = 0.0;
  for (double& x : differences) {
    (x > 0.0 ? above : below) += std::abs(x);
    x = std::abs(x);
  }
  std::ranges::sort(differences);
  int found = 1;  // the sample's own pattern
  return found <= most && !more_subsets(differences, 0, std::min(above, below), most, found);
}

/// The greatest sum of ranks of one sign that Wilcoxon's test of n differences still rejects; -1
/// for none.
int critical_sum(int n, double alpha) {
  const auto all = static_cast<std::size_t>(n * (n + 1) / 2);
  std::vector<double> chance(all + 1);
  chance[0] = 1.0;
  for (std::size_t rank = 1; rank <= static_cast<std::size_t>(n); ++rank) {
    for (std::size_t s = all; s >= rank; --s) chance[s] = (chance[s] + chance[s - rank]) / 2.0;
    for (std::size_t s = 0; s < rank; ++s) chance[s] /= 2.0;
  }
  std::size_t sums = 0;  // that are rare enough, from 0 on
  double below = 0.0;
  while (2.0 * (below += chance[sums]) <= alpha) ++sums;
  return static_cast<int>(sums) - 1;
}

bool signed_rank_rejects(std::vector<double> differences, int critical) {
  std::ranges::sort(differences, {}, [](double x) { return std::abs(x); });
  int above = 0, all = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const int rank = static_cast<int>(i) + 1;
    if (differences[i] > 0.0) above += rank;
    all += rank;
  }
  return std::min(above, all - above) <= critical;
}

}  // namespace

std::optional<double> simulated_power(PairedTest test, int n, double effect, double alpha) {
  // A pattern and its opposite count together.
  const double patterns = std::floor(std::ldexp(alpha, n - 1));
  const bool few = test == PairedTest::sign_flip ? patterns <= most_patterns : true;
  if (test == PairedTest::paired_t || n > most_differences || !few) return std::nullopt;
  const int critical = test == PairedTest::wilcoxon ? critical_sum(n, alpha) : 0;
  int rejected = 0;
  for (int k = 0; k < simulated; ++k) {
    std::vector<double> sample(normal_sample(k), normal_sample(k) + n);
    // Without scatter, all differences are the same.
    for (double& x : sample) x = std::isinf(effect) ? std::copysign(1.0, effect) : x + effect;
    const bool rejects = test == PairedTest::sign_flip
                             ? sign_flip_rejects(std::move(sample), static_cast<int>(patterns))
                             : signed_rank_rejects(std::move(sample), critical);
    rejected += rejects ? 1 : 0;
  }
  return static_cast<double>(rejected) / simulated;
}

}  // namespace shoal::analysis::statistics
