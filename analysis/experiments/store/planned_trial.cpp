#include "shoal/analysis/experiments/store/planned_trial.hpp"

#include <map>

namespace shoal::analysis {

StoredTrial planned_trial(const TrialList& list, const ListedTrial& planned) {
  const TrialGroup& group = list.groups()[planned.group];
  StoredTrial trial;
  trial.key = group.key(planned.cell, planned.replication);
  trial.group = group.name();
  trial.replication = planned.replication;
  trial.seed = list.seed(planned);
  for (std::size_t i = 0; i < group.columns().size(); ++i) {
    trial.factors.emplace_back(group.columns()[i], group.labels(planned.cell)[i]);
  }
  return trial;
}

std::optional<std::string> contradiction(const TrialList& list, const ListedTrial& planned,
                                         const StoredTrial& stored) {
  const StoredTrial right = planned_trial(list, planned);
  const auto differ = [](const std::string& column, const std::string& ours,
                         const std::string& studys) {
    return column + " is " + ours + ", and " + studys + " in the study";
  };
  if (stored.seed != right.seed) {
    return differ("seed", std::to_string(stored.seed), std::to_string(right.seed));
  }
  if (stored.replication != right.replication) {
    return differ("replication", std::to_string(stored.replication),
                  std::to_string(right.replication));
  }
  if (stored.group != right.group) {
    return differ("study_group", '"' + stored.group + '"', '"' + right.group + '"');
  }
  std::map<std::string, std::string> ours(stored.factors.begin(), stored.factors.end());
  for (const auto& [name, label] : right.factors) {
    const auto found = ours.find(name);
    if (found == ours.end()) return differ("f:" + name, "null", '"' + label + '"');
    if (found->second != label) {
      return differ("f:" + name, '"' + found->second + '"', '"' + label + '"');
    }
    ours.erase(found);
  }
  if (ours.empty()) return std::nullopt;
  const auto& [name, label] = *ours.begin();
  return differ("f:" + name, '"' + label + '"', "null");
}

}  // namespace shoal::analysis
