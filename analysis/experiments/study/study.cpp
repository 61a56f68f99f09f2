#include "shoal/analysis/experiments/study/study.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/statistic.hpp"
#include "shoal/analysis/experiments/study/renamed_keys.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> of_a_group{"scenario", "factor", "exclude", "design"};

/// A study that has no [[group]] is one group, without a name.
Setting with_groups(Setting root) {
  const Setting* grouped = root.find("group");
  Setting group;
  // The file as a whole has no line. That of the base stands for the group: it says beside which
  // file the base is.
  const Setting* base = root.find("scenario");
  group.origin = base ? base->origin : root.origin;
  Setting::Table rest;
  for (auto& [name, entry] : root.table()) {
    if (std::ranges::find(of_a_group, name) == of_a_group.end()) {
      rest.emplace_back(name, std::move(entry));
    } else if (grouped) {
      throw InputError(entry.origin, "a study with groups takes " + name + " in its [[group]]s");
    } else {
      group.table().emplace_back(name, std::move(entry));
    }
  }
  if (!grouped) {
    const Origin origin = group.origin;
    rest.emplace_back("group", Setting{Setting::List{std::move(group)}, origin});
  }
  root.value = std::move(rest);
  return root;
}

bool is_list_or_nothing(const Setting& setting) {
  return std::holds_alternative<Setting::List>(setting.value) ||
         (setting.is_table() && setting.table().empty());
}

template <class Request>
void require_names(const std::vector<Request>& requests, std::set<std::string>& taken) {
  for (const Request& request : requests) {
    if (taken.insert(request.name).second) continue;
    throw InputError(request.origin, "there are two tables called \"" + request.name +
                                         "\"; their files would be one");
  }
}

void require_known_values(const std::vector<std::string>& names, const Origin& origin) {
  for (const std::string& name : names) known_value(name, origin);
}

void require_known_series(const std::vector<std::string>& names, const Origin& origin) {
  for (const std::string& name : names) known_series(name, origin);
}

/// Throws InputError if the study names what no measure yields: better before its trials than
/// after.
void require_known_quantities(const Study& study) {
  require_known_series(study.series, study.origin);
  for (const TableRequest& table : study.tables) {
    require_known_values(table.measures, table.origin);
    require_known_series(table.series, table.origin);
    if (!table.against.empty()) known_series(table.against, table.origin);
  }
  for (const ComparisonRequest& comparison : study.comparisons) {
    require_known_values(comparison.measures, comparison.origin);
  }
  for (const SensitivityRequest& sensitivity : study.sensitivities) {
    require_known_values(sensitivity.measures, sensitivity.origin);
  }
  for (const AttributionRequest& attribution : study.attributions) {
    require_known_values(attribution.measures, attribution.origin);
  }
}

constexpr std::size_t longest_name = 100;

std::optional<std::string> name_complaint(const std::string& name, const std::string& noun) {
  if (name.empty()) return noun + " needs a name";
  if (name.size() > longest_name) {
    return "the name " + name.substr(0, 20) + "... has " + std::to_string(name.size()) +
           " letters; it becomes that of a file, and takes at most " + std::to_string(longest_name);
  }
  const bool plain = name.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789_-") == std::string::npos;
  if (!plain)
    return "the name \"" + name + "\" becomes that of a file; use letters, digits, _ and -";
  return std::nullopt;
}

template <class Request>
void declare_scope(Options<Request>& o) {
  o.text("name", &Request::name, "of its files, and its label in LaTeX");
  o.text("caption", &Request::caption, "what the table shows");
}

template <class Request>
void declare_cells(Options<Request>& o) {
  declare_scope(o);
  o.texts("groups", &Request::groups, "groups whose trials it is about; default: all");
  o.setting("where", &Request::where, "a table: factor = label or labels", "only these cells");
}

/// What is wrong with the name of a member that has no options.
std::optional<std::string> member_complaint(const RegistryBase& family, const std::string& option,
                                            const std::string& name) {
  if (family.find(name) != nullptr) return std::nullopt;
  return option + " has no value \"" + name + '"' + suggestion(name, family.names());
}

std::optional<std::string> test_complaint(const std::string& test) {
  return member_complaint(Registry<PairedTest>::instance(), "test", test);
}

template <class Request>
void declare_test(Options<Request>& o) {
  o.text("test", &Request::test,
         "test of paired differences (shoal list paired_tests), corrected by Holm over the whole "
         "table");
}

}  // namespace

void Group::declare(Options<Group>& o) {
  o.text("name", &Group::name, "what the group is called in tables");
  o.text("scenario", &Group::scenario,
         "base scenario: a name of the library, or a file relative to the study");
  o.setting("set", &Group::set, "a table of options", "changes to the scenario");
  o.tables("factor", &Group::factors, "what is varied; the last one runs fastest");
  o.setting("exclude", &Group::exclude, "a list of tables",
            "combinations that are not run: factor = label or labels");
  o.choice("design", &Group::design, "how cells are chosen from the factors");
  o.integer("replications", &Group::replications, "", in(0, 1e9),
            "trials of every cell; 0: as many as the study says");
}

std::optional<std::string> Group::complaint() const {
  // A study that asks for no tables has one of each group, called like it.
  if (!name.empty()) {
    if (auto wrong = name_complaint(name, "a group")) return wrong;
  }
  const bool moves = std::ranges::any_of(factors, [](const Factor& factor) {
    return factor.key == "scenario" ||
           std::ranges::all_of(factor.levels, [](const Level& l) { return !l.scenario.empty(); });
  });
  if (scenario.empty() && !(moves && !factors.empty())) {
    return "a base is missing; write scenario = \"...\" (shoal list scenarios shows the library)";
  }
  if (!set.is_table()) return "set takes a table of options of the scenario";
  if (!is_list_or_nothing(exclude)) return "exclude takes a list of tables ([[exclude]])";
  return std::nullopt;
}

void TableRequest::declare(Options<TableRequest>& o) {
  using T = TableRequest;
  declare_cells(o);
  o.texts("rows", &T::rows, "factors that run down the table; default: all that are not columns");
  o.texts("columns", &T::columns, "factors that run across the table");
  o.texts("pool", &T::pool, "factors whose levels are taken together as if they were replications");
  o.texts("measures", &T::measures, "what is shown of every trial (shoal list measures)");
  o.texts("series", &T::series, "what is shown against time, in rows, instead of measures");
  o.number("every", &T::every, "", above(0), "step of the rows of a series (s, or as `against`)");
  o.text("against", &T::against, "the series that stands in the rows; default: time");
  o.text("statistic", &T::statistic,
         "what stands in a cell, over replications (shoal list statistics)");
  o.word("best", &T::best,
         {{"none", Best::none}, {"lowest", Best::lowest}, {"highest", Best::highest}},
         "the value set in bold where a test corrected over the table tells it from all others");
  o.text("compare", &T::compare, "the factor whose levels compete for the best value");
  declare_test(o);
}

std::optional<std::string> TableRequest::complaint() const {
  if (auto wrong = name_complaint(name, "a table")) return wrong;
  const auto& statistics = Registry<Statistic>::instance();
  if (auto wrong = member_complaint(statistics, "statistic", statistic)) return wrong;
  if (auto wrong = test_complaint(test)) return wrong;
  if (measures.empty() == series.empty()) return "a table takes measures or series";
  if (!series.empty() && every == 0.0) return "a table of series needs every: the step of its rows";
  if (series.empty() && (every != 0.0 || !against.empty())) {
    return "every and against belong to a table of series";
  }
  if (best != Best::none && compare.empty()) {
    return "best needs compare: the factor whose levels compete";
  }
  if (best == Best::none && !compare.empty()) return "compare needs best: lowest or highest";
  return std::nullopt;
}

void ComparisonRequest::declare(Options<ComparisonRequest>& o) {
  using C = ComparisonRequest;
  declare_cells(o);
  o.text("factor", &C::factor, "the factor whose levels are compared");
  o.text("reference", &C::reference, "the level that the others are compared with");
  o.texts("measures", &C::measures, "what is compared (shoal list measures)");
  declare_test(o);
  o.number("resolve_percent", &C::resolve_percent, "%", above(0),
           "the last column says how many replications would show a difference so large");
}

std::optional<std::string> ComparisonRequest::complaint() const {
  if (auto wrong = name_complaint(name, "a comparison")) return wrong;
  if (auto wrong = test_complaint(test)) return wrong;
  if (factor.empty() || reference.empty()) return "a comparison needs factor and reference";
  if (measures.empty()) return "a comparison needs measures";
  return std::nullopt;
}

void SensitivityRequest::declare(Options<SensitivityRequest>& o) {
  using S = SensitivityRequest;
  declare_scope(o);
  o.text("group", &S::group, "the group with design saltelli or morris; default: the only one");
  o.texts("measures", &S::measures, "answers whose sensitivity is asked (shoal list measures)");
  o.flag("convergence", &S::convergence,
         "also a table of the indices from 1/8, 1/4 and 1/2 of the base samples");
}

std::optional<std::string> SensitivityRequest::complaint() const {
  if (auto wrong = name_complaint(name, "a sensitivity")) return wrong;
  if (measures.empty()) return "a sensitivity needs measures";
  return std::nullopt;
}

void AttributionRequest::declare(Options<AttributionRequest>& o) {
  using A = AttributionRequest;
  declare_scope(o);
  o.text("group", &A::group, "a grid of factors with two levels each; default: the only group");
  o.text("minus", &A::minus,
         "a group whose cells with the same labels are subtracted, seed by seed; it may lack "
         "factors");
  o.setting("reference", &A::reference, "a table: factor = label",
            "the level from which each factor is changed");
  o.texts("measures", &A::measures, "what is attributed (shoal list measures)");
}

std::optional<std::string> AttributionRequest::complaint() const {
  if (auto wrong = name_complaint(name, "an attribution")) return wrong;
  if (measures.empty()) return "an attribution needs measures";
  if (!reference.is_table() || reference.table().empty()) {
    return "an attribution needs reference: the level of each factor that is changed";
  }
  return std::nullopt;
}

void Study::declare(Options<Study>& o) {
  o.text("title", &Study::title, "one line on what is studied");
  o.integer("replications", &Study::replications, "", in(1, 1e9), "trials of every cell");
  o.integer(
      "seed", &Study::seed, "", in(0, 9e15),
      "of the first replication; the k-th has seed + k - 1 in every cell, so that cells share "
      "starts, noise and losses");
  o.setting("set", &Study::set, "a table of options", "changes to every scenario");
  o.tables("group", &Study::groups,
           "trials with the same factors; may be left out if there is one");
  o.tables("table", &Study::tables, "tables of cells");
  o.tables("comparison", &Study::comparisons, "tables of paired differences");
  o.tables("sensitivity", &Study::sensitivities, "tables of sensitivity indices");
  o.tables("attribution", &Study::attributions,
           "tables of what each of several changes accounts for");
  o.texts(
      "series", &Study::series,
      "numbers against time to store of every trial, besides those that tables and claims name");
  o.file("claims", &Study::claims_file, "a file of statements to test on the trials");
}

std::optional<std::string> Study::complaint() const {
  if (groups.empty()) return "a study needs a group";
  if (!set.is_table()) return "set takes a table of options of the scenario";
  std::set<std::string> names;
  for (const Group& group : groups) {
    if (groups.size() > 1 && group.name.empty()) return "each of several groups needs a name";
    if (!names.insert(group.name).second) return "there are two groups \"" + group.name + '"';
  }
  return std::nullopt;
}

Study read_study(const Setting& root) {
  Study study;
  study.written = with_groups(root);
  require_no_renamed_keys(study.written);
  read(study, study.written, "");
  if (!study.claims_file.path.empty()) {
    study.claims = read_claims(scenarios::read_toml(scenarios::resolved(study.claims_file)));
  }
  std::set<std::string> names;
  require_names(study.tables, names);
  require_names(study.comparisons, names);
  require_names(study.sensitivities, names);
  require_names(study.attributions, names);
  require_known_quantities(study);
  return study;
}

void set_replications(Setting& root, std::int64_t replications) {
  root.at_or_new("replications").value = replications;
  Setting* groups = root.find("group");
  if (!groups || groups->is_table()) return;
  for (Setting& group : std::get<Setting::List>(groups->value)) {
    std::erase_if(group.table(), [](const auto& entry) { return entry.first == "replications"; });
  }
}

bool looks_like_a_study(const Setting& root) {
  const Schema& study = schema_of<Study>();
  return std::ranges::any_of(root.table(), [&](const auto& entry) {
    return study.find(entry.first) != nullptr ||
           std::ranges::find(of_a_group, entry.first) != of_a_group.end();
  });
}

std::vector<std::string> library_studies() {
  std::vector<std::string> names;
  const fs::path folder = scenarios::library_path() / "studies";
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && !name.ends_with("_claims")) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

fs::path find_study(const std::string& name_or_path) {
  if (fs::exists(name_or_path)) return name_or_path;
  const fs::path shipped = scenarios::library_path() / "studies" / (name_or_path + ".toml");
  if (fs::exists(shipped)) return shipped;
  throw InputError("there is no file \"" + name_or_path + "\", and no study of that name ships" +
                   suggestion(name_or_path, library_studies()));
}

}  // namespace shoal::analysis
