#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr std::size_t exact_up_to = 32;  // 2 x 65536 sums: no dearer than sampling

// Sums that are closer than this, relative to the sum of all magnitudes, differ by rounding only.
constexpr double rounding = 1e-12;

/// The sums under all patterns of signs, ascending.
std::vector<double> signed_sums(Sample terms) {
  std::vector<double> sums{0.0}, minus, plus;
  for (const double term : terms) {
    minus = plus = sums;
    for (double& sum : minus) sum -= std::abs(term);
    for (double& sum : plus) sum += std::abs(term);
    sums.resize(2 * minus.size());
    std::ranges::merge(minus, plus, sums.begin());
  }
  return sums;
}

/// The share of the 2^n patterns whose sum is at least `limit`, without looking at each: the sums
/// of both halves of the terms are put in order and met from both ends (Horowitz and Sahni 1974).
double share_at_least(double limit, Sample terms) {
  const std::vector<double> first = signed_sums(terms.first(terms.size() / 2));
  const std::vector<double> second = signed_sums(terms.subspan(terms.size() / 2));
  std::size_t too_small = second.size();
  std::size_t patterns = 0;
  for (const double sum : first) {
    while (too_small > 0 && sum + second[too_small - 1] >= limit) --too_small;
    patterns += second.size() - too_small;
  }
  return std::ldexp(static_cast<double>(patterns), -static_cast<int>(terms.size()));
}

/// The sums of terms under random patterns of signs.
class RandomSums {
 public:
  explicit RandomSums(Sample terms) : size_(terms.size()) {
    for (std::size_t begin = 0; begin < size_; begin += bits) {
      const std::size_t end = std::min(begin + bits, size_);
      for (std::size_t i = begin; i < end; i += at_once) {
        add_sums(terms.subspan(i, std::min(at_once, end - i)));
      }
    }
  }

  /// Under the pattern of that number.
  double sum(const RandomStreams& random, std::uint32_t number) const {
    double sum = 0.0;
    const double* sums = sums_.data();
    std::size_t begin = 0;
    for (std::uint32_t draw = 0; begin < size_; ++draw) {
      for (const double u : random.uniform(Purpose::sign_flip, number, draw)) {
        const std::size_t end = std::min(begin + bits, size_);
        auto signs = static_cast<std::uint64_t>(u * 0x1p53);
        for (; begin < end; begin += std::min(at_once, end - begin)) {
          sum += sums[signs & (patterns - 1)];
          sums += patterns;
          signs >>= at_once;
        }
      }
    }
    return sum;
  }

 private:
  static constexpr std::size_t bits = 53;    // in one uniform number
  static constexpr std::size_t at_once = 8;  // so many signs tell which sum to take
  static constexpr std::size_t patterns = 1 << at_once;

  /// Under all patterns of their signs; a term that is not there has none.
  void add_sums(Sample terms) {
    for (std::size_t pattern = 0; pattern < patterns; ++pattern) {
      double sum = 0.0;
      for (std::size_t i = 0; i < terms.size(); ++i) {
        sum += ((pattern >> i) & 1) != 0 ? terms[i] : -terms[i];
      }
      sums_.push_back(sum);
    }
  }

  std::size_t size_;
  std::vector<double> sums_;
};

}  // namespace

std::optional<TestResult> sign_flip_test(Sample differences, Alternative alternative,
                                         const SignFlipOptions& options) {
  require_finite(differences);
  if (options.resamples < 1) throw std::invalid_argument("a sign-flip test needs resamples");
  if (differences.empty()) return std::nullopt;

  const double observed = std::accumulate(differences.begin(), differences.end(), 0.0);
  const double tie =
      rounding * std::accumulate(differences.begin(), differences.end(), 0.0,
                                 [](double sum, double x) { return sum + std::abs(x); });
  TestResult result{.statistic = mean(differences), .n = static_cast<int>(differences.size())};
  result.exact = differences.size() <= exact_up_to;

  // A pattern and its opposite are equally likely, so all three alternatives are one upper tail.
  const bool two_sided = alternative == Alternative::two_sided;
  const double outward = two_sided                             ? std::abs(observed)
                         : alternative == Alternative::greater ? observed
                                                               : -observed;
  if (two_sided && outward <= tie) {
    result.p_value = 1.0;
  } else if (result.exact) {
    result.p_value = (two_sided ? 2.0 : 1.0) * share_at_least(outward - tie, differences);
  } else {
    const RandomStreams random(options.seed);
    const RandomSums sums(differences);
    int as_far_out = 0;
    for (int number = 0; number < options.resamples; ++number) {
      const double sum = sums.sum(random, static_cast<std::uint32_t>(number));
      if ((two_sided ? std::abs(sum) : sum) >= outward - tie) ++as_far_out;
    }
    result.p_value = (as_far_out + 1.0) / (options.resamples + 1.0);
  }
  return result;
}

}  // namespace shoal::analysis::statistics
