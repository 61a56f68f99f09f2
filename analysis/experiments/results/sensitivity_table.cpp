#include "shoal/analysis/experiments/results/sensitivity_table.hpp"

#include "shoal/analysis/experiments/results/sensitivity_analysis.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::size_t analysed_group(const SensitivityRequest& request, const TrialList& list) {
  if (request.group.empty() && list.groups().size() > 1) {
    throw InputError(request.origin, "the study has several groups; name one with group");
  }
  const std::size_t place =
      request.group.empty() ? 0 : places_of_groups({request.group}, list, request.origin).front();
  const Group& group = list.groups()[place].group();
  const std::string& design = group.design.kind();
  const auto& analyses = Registry<SensitivityAnalysis>::instance();
  if (analyses.find(design) == nullptr) {
    throw InputError(request.origin, "a sensitivity needs design.kind to be one of " +
                                         listed(analyses.names()) + ", and the group has \"" +
                                         design + '"');
  }
  for (const Factor& factor : group.factors) {
    if (factor.only.table().empty()) continue;
    throw InputError(factor.origin,
                     "a factor with only is not varied in every cell, as the design " + design +
                         " supposes; leave only out");
  }
  return place;
}

}  // namespace

std::vector<Table> sensitivity_tables(const SensitivityRequest& request,
                                      const StudyResults& results) {
  const AnalysedGroup group(request, results, analysed_group(request, results.list()));
  return Choice<SensitivityAnalysis>(group.planned().group().design.kind()).make()->tables(group);
}

}  // namespace shoal::analysis
