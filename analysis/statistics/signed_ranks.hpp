#pragma once

#include <vector>

#include "shoal/analysis/statistics/differences.hpp"

namespace shoal::analysis::statistics {

/// Twice the midrank of a difference's magnitude (a whole number, also where some are tied), and
/// the sign of the difference.
struct SignedRank {
  int doubled = 0;
  bool positive = false;
};

/// Of all differences but those that are 0, by magnitude; those equal up to rounding are tied.
std::vector<SignedRank> signed_ranks(const Differences& differences);

}  // namespace shoal::analysis::statistics
