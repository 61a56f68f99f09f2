#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/sensitivity/bootstrap.hpp"

namespace shoal::analysis {

/// How much of the variance of an answer one factor accounts for, as shares of that variance.
struct SobolIndex {
  /// By itself. Estimates scatter around it: that of a small index may be negative.
  IndexEstimate first_order;
  /// With all its interactions. A sum of squares, so it is distinguishable from zero as soon as the
  /// factor changes some answer.
  IndexEstimate total;
};

/// Sobol' indices of all factors, in the order of the factors.
struct SobolIndices {
  int base_samples = 0;             ///< that count
  int left_out = 0;                 ///< base samples of which some answer is missing
  std::vector<SobolIndex> factors;  ///< empty where indices are not defined
  std::string undefined;            ///< why they are not; "" if they are
};

/// Estimates Sobol' indices from the answers to a design `saltelli`, in the order of its rows.
///
/// First order: Saltelli et al. 2010, Table 2 (b). Total: Jansen 1999, ibid. (f). The variance is
/// that of all answers to A and B, with 1 / 2N. Answers are centred on their mean before: it does
/// not change what is estimated, but without that the first-order estimate scatters with the ratio
/// of mean to standard deviation as soon as a base sample is left out (Sobol' and Levitan 1999).
///
/// A base sample of which any answer is missing is left out as a whole and counted: an index
/// compares answers within a base sample. If answers are missing where the factors make trials
/// fail, the indices hold for the rest of the range only.
///
/// Base samples are more even than the independent ones that the bootstrap takes them for, so that
/// intervals err on the long side: of test functions, those of 95 % held the truth in 98 % and more
/// of designs from 64 base samples on (of independent samples in 88 to 97 %). Of 16 base samples
/// they may be far too short (68 %).
///
/// Not defined for fewer than two base samples, and where answers to A and B do not vary (up to
/// rounding). Throws std::invalid_argument if `answers` are no multiple of factors + 2, or not
/// finite.
SobolIndices sobol_indices(Answers answers, int factors, const Resampling& resampling = {});

/// The same from the first N/8, N/4, N/2 and all N base samples of the design, each of which is a
/// design, too; numbers of base samples below one are left out. Indices that still move from one to
/// the next have not converged.
std::vector<SobolIndices> sobol_convergence(Answers answers, int factors,
                                            const Resampling& resampling = {});

}  // namespace shoal::analysis
