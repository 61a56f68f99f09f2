#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "shoal/analysis/study/study.hpp"

namespace shoal::analysis {

/// `sign-flip`, as it stands in notes.
std::string_view name_of(PairedTest test);

/// The two-sided p-value of paired differences. Differences that all are zero are no evidence (1);
/// nothing where the test has no answer: too few of them, or for Student's no scatter.
std::optional<double> paired_p_value(const std::vector<double>& differences, PairedTest test);

}  // namespace shoal::analysis
