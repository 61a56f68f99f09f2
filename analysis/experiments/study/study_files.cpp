#include "shoal/analysis/experiments/study/study_files.hpp"

#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/moved_keys.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

// A study may be read from another folder than the one it was written for.

void make_base_absolute(Setting& name) {
  auto* text = std::get_if<std::string>(&name.value);
  if (!text || text->empty()) return;
  const fs::path file = base_scenario(*text, name.origin);
  const bool ships = file.parent_path() == scenarios::library_path();
  if (!ships) *text = fs::absolute(file).lexically_normal().string();
}

void make_inherited_absolute(Setting& place) {
  if (auto* list = std::get_if<Setting::List>(&place.value)) {
    for (Setting& entry : *list) make_inherited_absolute(entry);
    return;
  }
  auto* text = std::get_if<std::string>(&place.value);
  if (!text || !scenarios::names_a_file(*text)) return;
  *text = detail::as_file({.type = "a file"}, place, scenarios::inherits_key).path.string();
}

/// What a table of changes names as a file.
void make_files_absolute(Setting& place, const std::string& key) {
  if (key == scenarios::inherits_key) return make_inherited_absolute(place);
  if (place.is_table()) {
    for (auto& [name, entry] : place.table()) make_files_absolute(entry, dotted(key, name));
    return;
  }
  scenarios::require_not_moved(key, place.origin);
  const OptionPlace named = locate(schema_of<scenarios::Scenario>(), key, place.origin);
  if (named.is_kind || named.member || !named.option->is_file) return;
  place.value = detail::as_file(*named.option, place, key).path.string();
}

void make_set_absolute(Setting& owner) {
  if (Setting* set = owner.find("set")) make_files_absolute(*set, "");
}

Setting::List* list_in(Setting& owner, const char* name) {
  Setting* found = owner.find(name);
  return found ? std::get_if<Setting::List>(&found->value) : nullptr;
}

/// The values of a factor as levels, which keep the labels that its trials are stored under.
Setting::List labelled(const std::vector<std::string>& labels, const std::string& key,
                       const Setting::List& values) {
  Setting::List levels;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Setting level;
    level.at_or_new("label").value = labels[i];
    if (key == "scenario") {
      level.at_or_new("scenario") = values[i];
    } else {
      assign(level.at_or_new("set"), key, values[i]);
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

void make_factor_absolute(Setting& factor) {
  if (Setting::List* levels = list_in(factor, "level")) {
    for (Setting& level : *levels) {
      if (Setting* base = level.find("scenario")) make_base_absolute(*base);
      make_set_absolute(level);
    }
  }
  const Setting* key = factor.find("key");
  const auto* name = key ? std::get_if<std::string>(&key->value) : nullptr;
  Setting::List* values = list_in(factor, "values");
  if (!name || !values) return;
  std::vector<std::string> labels;
  bool changed = false;
  for (Setting& value : *values) {
    labels.push_back(label_of(value));
    if (*name == "scenario") {
      make_base_absolute(value);
    } else {
      make_files_absolute(value, *name);
    }
    changed |= label_of(value) != labels.back();
  }
  if (!changed) return;
  Setting levels;
  levels.value = labelled(labels, *name, *values);
  if (!factor.find("name")) factor.at_or_new("name").value = name->substr(name->rfind('.') + 1);
  std::erase_if(factor.table(),
                [](const auto& entry) { return entry.first == "key" || entry.first == "values"; });
  factor.at_or_new("level") = std::move(levels);
}

}  // namespace

void write_study(const TrialList& list, const fs::path& folder) {
  Setting written = list.study().written;
  make_set_absolute(written);
  for (Setting& group : *list_in(written, "group")) {
    if (Setting* base = group.find("scenario")) make_base_absolute(*base);
    make_set_absolute(group);
    Setting::List* factors = list_in(group, "factor");
    if (!factors) continue;
    for (Setting& factor : *factors) make_factor_absolute(factor);
  }
  if (Setting* claims = written.find("claims")) {
    write_whole_file(folder / "claims.toml",
                     read_whole_file(scenarios::resolved(list.study().claims_file)).value());
    claims->value = std::string("claims.toml");
  }
  write_whole_file(folder / "study.toml", to_toml(written));
}

TrialList stored_list(const fs::path& folder) {
  const fs::path file = folder / "study.toml";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    throw InputError(folder.string() +
                     " holds no study.toml; name a folder that shoal sweep wrote");
  }
  return TrialList(read_study(scenarios::read_toml(file)));
}

}  // namespace shoal::analysis
