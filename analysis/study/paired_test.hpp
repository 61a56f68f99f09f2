#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "shoal/analysis/study/study.hpp"

namespace shoal::analysis {

/// `sign-flip`, as it stands in notes.
std::string_view name_of(PairedTest test);

/// The two-sided p-value of each sample of paired differences. Differences that all are zero are no
/// evidence (1); nothing where the test has no answer: too few of them, or for Student's no
/// scatter. Uses all processors; the numbers do not depend on how many there are.
std::vector<std::optional<double>> paired_p_values(const std::vector<std::vector<double>>& samples,
                                                   PairedTest test);

}  // namespace shoal::analysis
