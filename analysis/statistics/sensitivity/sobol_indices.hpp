#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/statistics/sensitivity/bootstrap.hpp"

namespace shoal::analysis {

/// How much of the variance of an answer one factor accounts for, as shares of that variance.
struct SobolIndex {
  /// By itself. Estimates scatter around it: that of a small index may be negative.
  IndexEstimate first_order;
  /// With all its interactions. Of one seed a sum of squares, so that it is distinguishable from
  /// zero as soon as the factor changes some answer; of several it scatters, too.
  IndexEstimate total;
};

/// What two factors do together, beyond what each does by itself.
struct SobolPair {
  int first = 0, second = 0;  ///< places of the factors, from 0
  IndexEstimate index;
};

/// Sobol' indices of all factors, in the order of the factors.
struct SobolIndices {
  int base_samples = 0;             ///< that count
  int left_out = 0;                 ///< base samples of which some answer is missing
  std::vector<SobolIndex> factors;  ///< empty where indices are not defined
  std::vector<SobolPair> pairs;     ///< empty without the rows for them, too
  std::string undefined;            ///< why they are not; "" if they are
};

/// The rows that a design `saltelli` has for each base sample.
struct SaltelliRows {
  int factors = 0;
  bool second_order = false;

  int count() const { return second_order ? 2 * factors + 2 : factors + 2; }
};

/// The answers to a design, row by row, for each of the seeds with which its cells were run.
using AnswersBySeed = std::vector<std::vector<std::optional<double>>>;

/// Estimates Sobol' indices from the answers to a design `saltelli`, in the order of its rows.
///
/// With one seed, the indices are those of the answers under that seed: what the seed does together
/// with a factor counts as done by the factor. With several, they are those of the mean over all
/// seeds. Each product of two answers that an estimator needs is taken of two different seeds, and
/// averaged over all pairs of them: what differs from seed to seed has then no part in variances
/// and indices, however few seeds there are (the U-statistic of Hoeffding 1948; the products of
/// means over seeds would leave a share of it that falls with their number only).
///
/// First order: Saltelli et al. 2010, Table 2 (b). Total: Jansen 1999, ibid. (f). Second order,
/// with rows BA_i: the mean of (BA_i - B) (AB_j - A) and of (BA_j - B) (AB_i - A), which are what
/// Saltelli 2002, theorem 2, leaves for a pair when the indices of its factors are taken away; the
/// other two then average over the rows of A and of B. The variance is that of all answers to A and
/// B, with 1 / 2N. Answers are centred on the mean of their seed before: it does not change what is
/// estimated, but without that the first-order estimate scatters with the ratio of mean to standard
/// deviation as soon as a base sample is left out (Sobol' and Levitan 1999).
///
/// A base sample of which any answer under any seed is missing is left out as a whole and counted:
/// an index compares answers within a base sample. If answers are missing where the factors make
/// trials fail, the indices hold for the rest of the range only.
///
/// Intervals are from resamples of base samples and, from three seeds on, of seeds at the same time
/// (Owen 2007, The pigeonhole bootstrap), so that they hold the scatter of both; of two seeds that
/// of base samples only. Base samples are more even than the independent ones that the bootstrap
/// takes them for, so that intervals err on the long side: of test functions, those of 95 % held
/// the truth in 98 % and more of designs from 64 base samples on (of independent samples in 88 to
/// 97 %). Of 16 base samples they may be far too short (68 %).
///
/// Not defined for fewer than two base samples, where answers to A and B do not vary (up to
/// rounding), and where, for all that the seeds show, their mean does not. Throws
/// std::invalid_argument if the answers of a seed are no whole base samples, or not finite.
SobolIndices sobol_indices(const AnswersBySeed& answers, SaltelliRows rows,
                           const Resampling& resampling = {});

/// The same from the first N/8, N/4, N/2 and all N base samples of the design, each of which is a
/// design, too; numbers of base samples below one are left out. Indices that still move from one to
/// the next have not converged.
std::vector<SobolIndices> sobol_convergence(const AnswersBySeed& answers, SaltelliRows rows,
                                            const Resampling& resampling = {});

}  // namespace shoal::analysis
