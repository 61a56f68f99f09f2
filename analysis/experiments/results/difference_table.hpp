#pragma once

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// Paired differences of every level of a factor from a reference level, on common seeds: their
/// mean with Student's 95 % interval, the p-values of the test asked for and of another one beside
/// it (Student's and an exact one), corrected by Holm over the table, two effect sizes, and how
/// many replications would show a difference of a given share of the reference's mean with either
/// test (two-sided, 5 % corrected for all comparisons of the table, with a power of 80 %). Times of
/// events are compared as restricted times, and by a log-rank test. Throws InputError if the study
/// does not have what it asks for.
Table difference_table(const ComparisonRequest& request, const StudyResults& results);

}  // namespace shoal::analysis
