#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr std::size_t most_exact_terms = 32;  // 2 x 65536 sums: as fast as sampling

// Sums that are closer than this, relative to the sum of all magnitudes, differ only by the
// rounding of the sums; that of the differences comes on top.
constexpr double rounding_of_signed_sums = 1e-12;

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
/// of both terms of the terms are put in order and met from both ends (Horowitz and Sahni 1974).
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
  explicit RandomSums(Sample terms) {
    for (std::size_t begin = 0; begin < terms.size(); begin += at_once) {
      add_table(terms.subspan(begin, std::min(at_once, terms.size() - begin)));
    }
  }

  /// Under the patterns of these numbers: `first`, `first` + 1, ...
  ///
  /// Table by table for all patterns, not pattern by pattern: the tables in use stay in the cache,
  /// and additions need not wait for one another.
  void sum(const RandomStreams& random, std::uint32_t first, std::span<double> sums) const {
    std::ranges::fill(sums, 0.0);
    for (std::size_t begin = 0; begin < tables_.size(); begin += per_draw) {
      const auto some = std::span(tables_).subspan(begin);
      for (std::size_t k = 0; k < sums.size(); ++k) {
        const auto number = first + static_cast<std::uint32_t>(k);
        const auto [low, high] = random.bits(Purpose::sign_flip, number, begin / per_draw);
        sums[k] += of_word(low, some.first(std::min(per_word, some.size())));
        if (some.size() > per_word) {
          sums[k] +=
              of_word(high, some.subspan(per_word, std::min(per_word, some.size() - per_word)));
        }
      }
    }
  }

 private:
  static constexpr std::size_t at_once = 8;  // so many signs tell which sum to take
  static constexpr std::size_t per_word = 64 / at_once, per_draw = 2 * per_word;
  /// The sums of a few terms under all patterns of their signs.
  using SumsOfFew = std::array<double, 1 << at_once>;

  static double of_word(std::uint64_t signs, std::span<const SumsOfFew> tables) {
    double sum = 0.0;
    for (const SumsOfFew& table : tables) {
      sum += table[signs % table.size()];
      signs >>= at_once;
    }
    return sum;
  }

  void add_table(Sample few) {
    SumsOfFew& sums = tables_.emplace_back();
    for (std::size_t pattern = 0; pattern < sums.size(); ++pattern) {
      for (std::size_t i = 0; i < few.size(); ++i) {
        sums[pattern] += ((pattern >> i) & 1) != 0 ? few[i] : -few[i];
      }
    }
  }

  std::vector<SumsOfFew> tables_;
};

}  // namespace

double least_sign_flip_p_value(int n) {
  const bool exact = static_cast<std::size_t>(n) <= most_exact_terms;
  return exact ? std::ldexp(1.0, 1 - n) : 1.0 / (SignFlipOptions{}.resamples + 1.0);
}

std::optional<TestResult> sign_flip_test(const Differences& given, Alternative alternative,
                                         const SignFlipOptions& options) {
  // Parts of the greatest doubles have sums, and the same p-value.
  std::vector<double> terms = given.values();
  double part = 1.0;
  if (std::ranges::any_of(terms, [](double x) { return std::abs(x) > 1e290; })) part = 0x1p-100;
  for (double& x : terms) x *= part;
  const Sample differences = terms;
  if (options.resamples < 1) throw std::invalid_argument("a sign-flip test needs resamples");
  if (differences.empty()) return std::nullopt;

  const double observed = std::accumulate(differences.begin(), differences.end(), 0.0);
  const double tie = part * given.rounding() * static_cast<double>(differences.size()) +
                     rounding_of_signed_sums *
                         std::accumulate(differences.begin(), differences.end(), 0.0,
                                         [](double sum, double x) { return sum + std::abs(x); });
  TestResult result{.statistic = mean(given.values()), .n = static_cast<int>(differences.size())};
  result.exact = differences.size() <= most_exact_terms;

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
    std::array<double, 256> block;
    std::ptrdiff_t as_far_out = 0;
    for (int done = 0; done < options.resamples; done += static_cast<int>(block.size())) {
      const std::span<double> some(
          block.data(), std::min(block.size(), static_cast<std::size_t>(options.resamples - done)));
      sums.sum(random, static_cast<std::uint32_t>(done), some);
      as_far_out += std::ranges::count_if(
          some, [&](double sum) { return (two_sided ? std::abs(sum) : sum) >= outward - tie; });
    }
    result.p_value = (static_cast<double>(as_far_out) + 1.0) / (options.resamples + 1.0);
  }
  return result;
}

}  // namespace shoal::analysis::statistics
