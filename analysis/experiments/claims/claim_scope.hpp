#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_request.hpp"
#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/selection.hpp"

namespace shoal::analysis {

struct CellPlace {
  std::size_t group, cell;
};

/// What the trials of some cells say, of the replications (which share a seed) that have a number
/// in each of the cells.
struct SharedNumbers {
  std::vector<std::vector<double>> of;  ///< cells x replications
  int trials = 0;                       ///< replications that should have given numbers
  int never_reached = 0;  ///< those counted with what bounds an event that did not come

  std::size_t count() const { return of.front().size(); }
};

/// The cells that a claim is about, in which only the factors it compares differ.
struct ClaimScope {
  const StudyResults& results;
  const TestedStatement& asked;
  std::vector<CellPlace> cells;
  std::string title;  ///< of the factors that are the same in all these cells; "" for none

  /// The only cell of the scope that a selection holds; it may name the group. Throws InputError if
  /// there is none, or more.
  CellPlace cell(const CellSelection& selection) const;
  /// `period = 30` of a cell, for these factors.
  std::string label(CellPlace place, const std::vector<std::string>& factors) const;

  SharedNumbers numbers(const std::vector<CellPlace>& places) const;
};

/// The cells that `where` leaves, parted by the factors that the claim does not compare. Throws
/// InputError if the claim names what the study does not have.
std::vector<ClaimScope> claim_scopes(const TestedStatement& asked, const Setting& where,
                                     const StudyResults& results,
                                     const std::vector<std::string>& compared);

/// The levels of a factor in the cells that a statement is about, in the order of the study. Throws
/// InputError if one of its groups does not have it.
std::vector<std::string> levels_of(const std::string& factor, const TestedStatement& asked,
                                   const TrialList& list);

}  // namespace shoal::analysis
