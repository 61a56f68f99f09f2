#include "shoal/analysis/statistics/signed_ranks.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "shoal/analysis/statistics/effect_size.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {
namespace {

constexpr std::size_t most_exact_ranks = 100;  // a million additions

/// Twice the sum of the ranks, of all and of positive differences.
struct RankSums {
  double all = 0.0, positive = 0.0;
};
RankSums rank_sums(const std::vector<SignedRank>& ranks) {
  RankSums sums;
  for (const SignedRank& rank : ranks) {
    sums.all += rank.doubled;
    if (rank.positive) sums.positive += rank.doubled;
  }
  return sums;
}

/// How far a sum of positive ranks lies from what is expected, in the direction that counts.
double outward(Alternative alternative, double positive, double all) {
  const double excess = positive - all / 2.0;
  if (alternative == Alternative::greater) return excess;
  if (alternative == Alternative::less) return -excess;
  return std::abs(excess);
}

double exact_p_value(const std::vector<SignedRank>& ranks, Alternative alternative) {
  const auto [all, positive] = rank_sums(ranks);
  // chance[s] that the positive ranks sum up to s when each sign is tossed.
  std::vector<double> chance(static_cast<std::size_t>(all) + 1);
  chance[0] = 1.0;
  std::size_t reached = 0;
  for (const SignedRank& rank : ranks) {
    const auto step = static_cast<std::size_t>(rank.doubled);
    reached += step;
    for (std::size_t s = reached; s >= step; --s) chance[s] = (chance[s] + chance[s - step]) / 2.0;
    for (std::size_t s = 0; s < step; ++s) chance[s] /= 2.0;
  }
  const double observed = outward(alternative, positive, all);
  double p_value = 0.0;
  for (std::size_t s = 0; s < chance.size(); ++s) {
    if (outward(alternative, static_cast<double>(s), all) >= observed) p_value += chance[s];
  }
  return p_value;
}

double normal_p_value(const std::vector<SignedRank>& ranks, Alternative alternative) {
  const auto [all, positive] = rank_sums(ranks);
  double variance = 0.0;  // of the doubled sum; the midranks have the correction for ties in them
  for (const SignedRank& rank : ranks) variance += 0.25 * rank.doubled * rank.doubled;
  const double one_half = 1.0;  // doubled, too: for continuity
  const double z = (outward(alternative, positive, all) - one_half) / std::sqrt(variance);
  if (alternative != Alternative::two_sided) return cdf(complement(boost::math::normal(), z));
  return z > 0.0 ? 2.0 * cdf(complement(boost::math::normal(), z)) : 1.0;
}

}  // namespace

std::vector<SignedRank> signed_ranks(const Differences& differences) {
  std::vector<double> ordered;
  std::ranges::copy_if(differences.values(), std::back_inserter(ordered),
                       [&](double x) { return !differences.is_zero(x); });
  const auto magnitude = [](double x) { return std::abs(x); };
  std::ranges::stable_sort(ordered, {}, magnitude);

  std::vector<SignedRank> ranks;
  while (ranks.size() < ordered.size()) {
    const std::size_t first = ranks.size();
    std::size_t last = first;
    const auto ties = [&](double x) {
      return magnitude(x) - magnitude(ordered[first]) <= differences.rounding();
    };
    while (last + 1 < ordered.size() && ties(ordered[last + 1])) ++last;
    const auto doubled = static_cast<int>(first + 1 + last + 1);
    for (std::size_t i = first; i <= last; ++i) ranks.push_back({doubled, ordered[i] > 0.0});
  }
  return ranks;
}

std::optional<TestResult> signed_rank_test(const Differences& differences,
                                           Alternative alternative) {
  const std::vector<SignedRank> ranks = signed_ranks(differences);
  if (ranks.empty()) return std::nullopt;
  const bool exact = ranks.size() <= most_exact_ranks;
  return TestResult{
      .statistic = rank_sums(ranks).positive / 2.0,
      .p_value = exact ? exact_p_value(ranks, alternative) : normal_p_value(ranks, alternative),
      .n = static_cast<int>(ranks.size()),
      .exact = exact};
}

std::optional<double> rank_biserial_correlation(const Differences& differences) {
  const std::vector<SignedRank> ranks = signed_ranks(differences);
  if (ranks.empty()) return std::nullopt;
  const auto [all, positive] = rank_sums(ranks);
  return (2.0 * positive - all) / all;
}

}  // namespace shoal::analysis::statistics
