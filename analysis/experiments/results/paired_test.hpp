#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/statistics/differences.hpp"

namespace shoal::analysis {

/// The two-sided p-value of each sample of paired differences. Differences that all are zero are no
/// evidence (1); nothing where the test has no answer: too few of them, or for Student's no
/// scatter. Uses all processors; the numbers do not depend on how many there are.
std::vector<std::optional<double>> paired_p_values(
    const std::vector<statistics::Differences>& samples, const PairedTest& test);

/// Whether a p-value is the least that these differences could have given.
bool at_floor(double p_value, const statistics::Differences& differences, const PairedTest& test);

/// What the tests of a table can show at all, whatever their differences: the least p-value that
/// the largest of these samples can give, corrected by Holm over those that were tested; and, where
/// that is not significant, the fewest pairs with which it would be. Nothing for tests without a
/// least p-value, or without samples.
std::optional<std::string> note_on_floor(const std::vector<statistics::Differences>& samples,
                                         const PairedTest& test);

}  // namespace shoal::analysis
