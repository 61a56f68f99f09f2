#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_request.hpp"
#include "shoal/analysis/experiments/study/factor.hpp"
#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/paired_test.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// Trials with the same factors: a base scenario, what is varied, and how often it is repeated.
struct Group {
  std::string name;
  std::string scenario;  ///< a file, or a name of the library
  Setting set;           ///< changes to it
  std::vector<Factor> factors;
  Setting exclude;  ///< list of tables, factor = label or labels: combinations that are not run
  Choice<Design> design{"grid"};
  std::int64_t replications = 0;  ///< 0: as many as the study
  Origin origin;

  static constexpr const char* noun = "a group";
  static void declare(Options<Group>& o);
  std::optional<std::string> complaint() const;
};

enum class Best { none, lowest, highest };

using statistics::PairedTest;

/// A table of cells: rows and columns over factors, a statistic over replications in each.
struct TableRequest {
  std::string name, caption;
  std::vector<std::string> groups;  ///< default: all
  Setting where;
  std::vector<std::string> rows, columns;
  std::vector<std::string> measures;
  std::vector<std::string> series;  ///< instead of measures: against time
  double every = 0.0;               ///< of time, or of what the series stands against
  std::string against;              ///< another series; default: time
  std::vector<std::string> pool;    ///< factors whose levels are taken together
  std::string statistic = "mean +- ci95";
  Best best = Best::none;
  std::string compare;  ///< the factor whose levels compete for the best value
  std::string test = "sign_flip";
  Origin origin;

  static constexpr const char* noun = "a table";
  static void declare(Options<TableRequest>& o);
  std::optional<std::string> complaint() const;
};

/// A table of paired differences from a reference level, on common seeds.
struct ComparisonRequest {
  std::string name, caption;
  std::vector<std::string> groups;
  Setting where;
  std::string factor, reference;
  std::vector<std::string> measures;
  std::string test = "sign_flip";
  double resolve_percent = 5.0;  ///< the difference, in percent of the reference's mean, for which
                                 ///< the number of replications is printed
  Origin origin;

  static constexpr const char* noun = "a comparison";
  static void declare(Options<ComparisonRequest>& o);
  std::optional<std::string> complaint() const;
};

/// A table of sensitivities to the factors of a group, whose design was made for that.
struct SensitivityRequest {
  std::string name, caption;
  std::string group;
  std::vector<std::string> measures;
  bool convergence = true;  ///< also a table of indices against the number of base samples
  Origin origin;

  static constexpr const char* noun = "a sensitivity";
  static void declare(Options<SensitivityRequest>& o);
  std::optional<std::string> complaint() const;
};

/// A table of what each of several changes accounts for in the difference that they make together.
struct AttributionRequest {
  std::string name, caption;
  std::string group;  ///< a grid whose factors have two levels each; default: the only one
  std::string minus;  ///< a group whose cells are subtracted, seed by seed; "" for none
  Setting reference;  ///< factor -> label: from where each is changed
  std::vector<std::string> measures;
  Origin origin;

  static constexpr const char* noun = "an attribution";
  static void declare(Options<AttributionRequest>& o);
  std::optional<std::string> complaint() const;
};

/// From base scenarios to the tables of a paper: what a study file says.
struct Study {
  std::string title;
  std::int64_t replications = 5;
  std::int64_t seed = 1;  ///< of the first replication; the k-th has seed + k - 1, in every cell
  Setting set;            ///< changes to every scenario
  std::vector<Group> groups;
  std::vector<TableRequest> tables;
  std::vector<ComparisonRequest> comparisons;
  std::vector<SensitivityRequest> sensitivities;
  std::vector<AttributionRequest> attributions;
  FilePath claims_file;
  ClaimFile claims;
  std::vector<std::string> series;  ///< stored of every trial, besides those that tables name
  Setting written;                  ///< what all this was read from
  Origin origin;

  static constexpr const char* noun = "a study";
  static void declare(Options<Study>& o);
  std::optional<std::string> complaint() const;
};

/// Reads a study, with its claims, and checks all that can be checked without its scenarios. A
/// study of one group may write its scenario, factors, exclusions and design without [[group]].
/// Throws InputError.
Study read_study(const Setting& root);

/// Sets the replications of a study that is yet to be read, those of its groups included.
void set_replications(Setting& root, std::int64_t replications);

/// Whether a file is meant as a study and not as a scenario: by the names that stand in it.
bool looks_like_a_study(const Setting& root);

/// The file of a study given by path, or by its name among those that ship. Throws InputError.
std::filesystem::path find_study(const std::string& name_or_path);

/// Names of the studies that ship, sorted.
std::vector<std::string> library_studies();

}  // namespace shoal::analysis
