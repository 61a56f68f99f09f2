#include <algorithm>
#include <cmath>

#include "shoal/analysis/statistics/paired_test.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/statistics/simulated_power.hpp"

namespace shoal::analysis::statistics {
namespace {

// With more patterns further out, the test has the power of Student's.
constexpr double most_patterns = 256.0;

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

struct SignFlip final : PairedTest {
  std::string title() const override { return "sign-flip"; }

  std::optional<TestResult> test(const Differences& differences) const override {
    return sign_flip_test(differences);
  }
  double least_p_value(int n) const override { return least_sign_flip_p_value(n); }

  double power(int n, double effect, double alpha) const override {
    // A pattern and its opposite count together.
    const double patterns = std::floor(std::ldexp(alpha, n - 1));
    if (n > most_simulated_differences || patterns > most_patterns) {
      return paired_t_power(n, effect, 1.0, alpha);
    }
    return simulated_power(n, effect, [&](std::vector<double> sample) {
      return sign_flip_rejects(std::move(sample), static_cast<int>(patterns));
    });
  }

  static void declare(Options<SignFlip>&) {}
};

const Register<PairedTest, SignFlip> registered{
    "sign_flip",
    "Fisher's randomisation test of the mean (The design of experiments 1935, sec. 21)"};

}  // namespace

std::unique_ptr<PairedTest> randomisation_test() {
  return std::make_unique<SignFlip>();
}

}  // namespace shoal::analysis::statistics
