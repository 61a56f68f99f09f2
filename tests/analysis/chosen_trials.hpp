#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_verdicts.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/toml_file.hpp"

/// Studies whose trials "gave" chosen numbers, and claims on them.
namespace shoal::analysis::chosen_trials {

using Measures = std::vector<std::pair<std::string, std::optional<double>>>;
namespace fs = std::filesystem;

/// Where a trial stands: `label("behaviour")`, and its replication from 0.
struct Place {
  std::string group;
  std::vector<std::string> names, labels;
  int k;
  std::string label(const std::string& name) const {
    return labels[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())];
  }
};
using Gave = std::function<Measures(const Place&)>;

inline const char* const factors_of_a_group = R"(
[[group.factor]]
name = "settings"
levels_of_settings
[[group.factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing"]
[[group.factor]]
name = "period"
key = "ping.period_s"
values = [10, 20, 30]
)";

inline std::string study_text(int replications) {
  std::string of_group = factors_of_a_group;
  const std::string word = "levels_of_settings";
  of_group.replace(of_group.find(word), word.size(),
                   "[[group.factor.level]]\nlabel = \"text\"\n[[group.factor.level]]\nlabel = "
                   "\"program\"\nset = { ping.bearing_sd_deg = 1 }");
  std::string text =
      "replications = " + std::to_string(replications) + "\nclaims = \"claims.toml\"\n";
  for (const std::string name : {"calm", "rough"}) {
    text += "[[group]]\nname = \"" + name + "\"\nscenario = \"construction_square\"\n" + of_group;
  }
  return text;
}

class ChosenTrials : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("shoal_claims_" + std::to_string(::getpid())) / "study";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  /// The claims of a file on a study whose trials gave these measures; a trial without any failed.
  Judgement judged(const std::string& claims, const Gave& gave, int replications = 8,
                   const std::vector<scenarios::Series>& series = {}) {
    write_whole_file(folder_ / "claims.toml", claims);
    write_whole_file(folder_ / "study.toml", study_text(replications));
    const TrialList list(read_study(scenarios::read_toml(folder_ / "study.toml")));
    require_answerable(list);
    Store store(folder_, Store::Access::write);
    store.together([&] {
      for (const ListedTrial& planned : list.all_trials()) {
        const TrialGroup& group = list.groups()[planned.group];
        const auto labels = group.labels(planned.cell);
        StoredTrial trial = planned_trial(list, planned);
        trial.program = "test";
        trial.measures = gave(
            {group.name(), group.columns(), {labels.begin(), labels.end()}, planned.replication});
        if (trial.measures.empty()) trial.failure = "it sank";
        trial.series = series;
        store.write(trial);
      }
    });
    return judged_claims(read_results(list, folder_), folder_);
  }

  /// The one claim on energies, in the group `calm` under the settings of the text.
  ClaimResult judged_one(const std::string& test, const std::function<double(const Place&)>& energy,
                         const std::string& more = "", int replications = 8) {
    const Judgement judgement = judged(
        "[[claim]]\nsays = \"so\"\nmeasure = \"energy_mean_wh\"\ngroups = [\"calm\"]\n" +
            (more.empty() ? std::string("where = { settings = \"text\", period = 10 }") : more) +
            "\ntest = " + test,
        [&](const Place& place) {
          return Measures{{"energy_mean_wh", energy(place)}};
        },
        replications);
    return judgement.statements.front().parts.front().columns.front()->result;
  }

  fs::path folder_;
};

inline const std::vector<double> eight_noises{0.3, -0.2, 0.5, -0.4, 0.1, -0.6, 0.2, 0.1};

inline double noise_of(int k) {
  return eight_noises[static_cast<std::size_t>(k) % eight_noises.size()];
}

inline bool is_rigid(const Place& place) {
  return place.label("behaviour") == "rigid_registration";
}

inline const std::string of_rigid = "cells = { behaviour = \"rigid_registration\" }, ";
inline const std::string than = "than = { behaviour = \"pairwise_referencing\" }, ";

inline std::string lower(const std::string& smallest) {
  return "{ kind = \"lower\", lower = { " + of_rigid + than + smallest + " } }";
}

}  // namespace shoal::analysis::chosen_trials
