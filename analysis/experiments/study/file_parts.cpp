#include "shoal/analysis/experiments/study/file_parts.hpp"

#include "shoal/analysis/experiments/study/study.hpp"

namespace shoal::analysis {

const std::vector<FilePart>& file_parts() {
  static const std::vector<FilePart> parts{
      {"study", "a study file", schema_of<Study>()},
      {"group", "[[group]] of a study; of its only group, at the top", schema_of<Group>()},
      {"factor", "[[group.factor]], or [[factor]] of the only group", schema_of<Factor>()},
      {"level", "[[group.factor.level]], or [[factor.level]]", schema_of<Level>()},
      {"table", "[[table]] of a study", schema_of<TableRequest>()},
      {"comparison", "[[comparison]] of a study", schema_of<ComparisonRequest>()},
      {"sensitivity", "[[sensitivity]] of a study", schema_of<SensitivityRequest>()},
      {"attribution", "[[attribution]] of a study", schema_of<AttributionRequest>()},
      {"claims", "a file of claims, named by `claims` of a study", schema_of<ClaimFile>()},
      {"statement", "[[statement]] of a file of claims", schema_of<StatementWords>()},
      {"claim", "[[claim]] of a file of claims", schema_of<Claim>()},
      {"cause", "[claim.cause] of a file of claims", schema_of<Cause>()},
  };
  return parts;
}

}  // namespace shoal::analysis
