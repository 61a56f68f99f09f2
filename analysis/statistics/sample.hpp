#pragma once

#include <optional>
#include <span>

namespace shoal::analysis::statistics {

/// Independent observations of one number: a measure of trials under different seeds, or the
/// differences of two conditions under the same seeds. All statistics throw std::invalid_argument
/// if a value is not finite; what becomes of trials without a value is decided before.
using Sample = std::span<const double>;

void require_finite(Sample values);

/// NaN for n = 0.
double mean(Sample values);

/// The sample's, with n - 1; NaN for n < 2.
double standard_deviation(Sample values);

/// Of the mean: sd / sqrt(n). Nothing where the sample says nothing about its scatter: for n < 2,
/// and if all values are the same up to rounding (ten units of it, as R's t.test has it). There
/// are then no intervals and no t tests either: equal values are no proof that the mean is known.
std::optional<double> standard_error(Sample values);

}  // namespace shoal::analysis::statistics
