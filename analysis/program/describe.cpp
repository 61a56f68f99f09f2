#include <fmt/core.h>

#include <algorithm>

#include "commands.hpp"
#include "print_options.hpp"
#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/study/file_parts.hpp"
#include "shoal/analysis/experiments/study/renamed_keys.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/core/lower_case.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

/// Every member of that name, of whatever family. Returns whether there is one.
bool describe_members(const std::string& name, std::vector<std::string>& known) {
  bool found = false;
  for (const RegistryBase* family : families()) {
    for (const MemberInfo& member : family->members()) {
      known.push_back(member.name);
      if (member.name != name) continue;
      const std::string key = key_of(*family, schema_of<scenarios::Scenario>());
      print_member(*family, member, dotted(key, name));
      found = true;
    }
  }
  return found;
}

/// What measures yield under that name: a value, a series, or both.
bool describe_quantities(const std::string& name, std::vector<std::string>& known) {
  bool found = false;
  const auto describe = [&](const analysis::Quantity& quantity, const char* what) {
    known.push_back(quantity.name);
    if (quantity.name != name) return;
    const std::string unit = quantity.unit.empty() ? "a pure number" : "in " + quantity.unit;
    fmt::print("{} ({} of a trial, {}): {}\n", name, what, unit, quantity.meaning);
    if (!quantity.censored_by.empty()) {
      fmt::print("  an event: tables count trials that never see it as later than {}\n",
                 quantity.censored_by);
    }
    if (!quantity.event.empty()) {
      fmt::print("  taken at an event, or at the end: {} says whether it came\n", quantity.event);
    }
    found = true;
  };
  for (const auto& value : analysis::known_values()) describe(value, "value");
  for (const auto& series : analysis::known_series()) describe(series, "series");
  return found;
}

bool describe_scenario(const std::string& name, std::vector<std::string>& known) {
  const std::vector<std::string> names = scenarios::library_scenarios();
  known.insert(known.end(), names.begin(), names.end());
  if (std::ranges::find(names, name) == names.end()) return false;
  const Setting root = scenarios::read_toml(scenarios::find_scenario(name));
  fmt::print("{}", to_toml(scenarios::resolved_scenario(scenarios::read_scenario(root))));
  return true;
}

/// As it was written: its comments say where each value comes from.
template <class FileOf>
bool describe_file(const std::string& name, const std::vector<std::string>& names, FileOf file_of,
                   std::vector<std::string>& known) {
  known.insert(known.end(), names.begin(), names.end());
  if (std::ranges::find(names, name) == names.end()) return false;
  fmt::print("{}", read_whole_file(file_of(name)).value());
  return true;
}

/// A table of study and claim files, or an option in one.
bool describe_part(const std::string& name, std::vector<std::string>& known) {
  const std::string first = name.substr(0, name.find('.'));
  for (const analysis::FilePart& part : analysis::file_parts()) {
    known.emplace_back(part.name);
    if (first != part.name) continue;
    const std::string rest = first == name ? "" : name.substr(first.size() + 1);
    const Option* option = part.schema.find(rest.substr(0, rest.find('.')));
    // The entries of a list have a part of their own.
    if (option && option->type == "a list of tables" && describe_part(rest, known)) return true;
    if (rest.empty()) {
      fmt::print("{}: {}\n", part.name, part.written);
      print_schema(part.schema, part.name);
    } else {
      Setting defaults;
      defaults.at_or_new(first) = part.schema.defaults;
      const Option table{.name = first, .meaning = part.written, .table = &part.schema};
      print_key(Schema{{table}, defaults, part.written}, name);
    }
    return true;
  }
  return false;
}

/// The options of studies that name a member without a table of options: their default is one.
void describe_naming_options(const RegistryBase& family) {
  std::vector<std::string> ignored;
  for (const analysis::FilePart& part : analysis::file_parts()) {
    const Setting* by_default = part.schema.defaults.find(family.family());
    const auto* member = by_default ? std::get_if<std::string>(&by_default->value) : nullptr;
    if (member && family.find(*member)) {
      describe_part(std::string(part.name) + "." + family.family(), ignored);
    }
  }
}

/// A family, or FAMILY.MEMBER and what follows: the key that chooses it is another way to say it.
bool describe_family(const std::string& name, std::vector<std::string>& known) {
  const std::string first = name.substr(0, name.find('.'));
  for (const RegistryBase* family : families()) {
    known.push_back(family->family());
    if (first != family->family()) continue;
    const Schema& scenario = schema_of<scenarios::Scenario>();
    const std::string key = key_of(*family, scenario);
    if (first == name || (key.empty() && name == first + ".kind")) {
      list(first);
      if (!key.empty()) {
        if (locate(scenario, key).option->of_all) {
          print_key(scenario, key);
        } else {
          fmt::print("chosen by {}.kind\n", key);
        }
      } else {
        describe_naming_options(*family);
      }
    } else if (!key.empty()) {
      print_key(scenario, key + name.substr(first.size()));
    } else {
      const Option choice{.name = first, .meaning = family->meaning(), .choice = family};
      print_key(Schema{{choice}, {}, "a scenario"}, name);
    }
    return true;
  }
  return false;
}

bool describe_inherits(const std::string& name, std::vector<std::string>& known) {
  known.emplace_back(scenarios::inherits_key);
  if (name != scenarios::inherits_key) return false;
  fmt::print(
      "{}\n    whose settings hold where the scenario says nothing; later ones before earlier "
      "ones\n"
      "    takes the name of a set or scenario, a file, or a list of these; sets are\n",
      name);
  for (const std::string& set : scenarios::library_sets()) {
    fmt::print("      {:<26} {}\n", set, scenarios::set_summary(set));
  }
  return true;
}

/// The keys of a schema, at any depth, that end with this name. `above`: the families whose
/// members' options are being looked through, which may choose one another.
void find_keys(const Schema& schema, const std::string& path, const std::string& name,
               std::vector<const RegistryBase*> above, std::vector<std::string>& found) {
  for (const Option& option : schema.options) {
    const std::string key = dotted(path, option.name);
    if (option.name == name) found.push_back(key);
    if (option.table) find_keys(*option.table, key, name, above, found);
    if (!option.choice || std::ranges::find(above, option.choice) != above.end()) continue;
    above.push_back(option.choice);
    for (const MemberInfo& member : option.choice->members()) {
      find_keys(member.schema(), key + "." + member.name, name, above, found);
    }
    above.pop_back();
  }
}

/// An option by its last name, of which there may be several.
bool describe_last_name(const std::string& name) {
  std::vector<std::string> of_scenarios, of_parts;
  find_keys(schema_of<scenarios::Scenario>(), "", name, {}, of_scenarios);
  for (const analysis::FilePart& part : analysis::file_parts()) {
    const Option* option = part.schema.find(name);
    if (option) of_parts.push_back(std::string(part.name) + "." + name);
  }
  for (const std::string& key : of_scenarios) print_key(schema_of<scenarios::Scenario>(), key);
  std::vector<std::string> ignored;
  for (const std::string& key : of_parts) describe_part(key, ignored);
  return !of_scenarios.empty() || !of_parts.empty();
}

}  // namespace

void describe(const std::string& name) {
  analysis::require_not_renamed(name);
  const Schema& root = schema_of<scenarios::Scenario>();
  const std::string first = name.substr(0, name.find('.'));
  std::vector<std::string> known = root.names();
  const Option* option = root.find(first);
  // A family of which all members are in use is described as a family, below.
  bool found = option && !(option->of_all && first == name);
  if (found) print_key(root, name);
  found |= describe_file(name, scenarios::library_sets(), scenarios::set_file, known);
  found |= describe_members(name, known);
  found |= describe_quantities(name, known);
  found = found || describe_part(name, known);
  found = found || describe_family(name, known);
  found = found || describe_scenario(name, known);
  found = found || describe_file(name, analysis::library_studies(), analysis::find_study, known);
  found = found || describe_inherits(name, known);
  if (!found && is_listed(name)) return list(name);
  found = found || describe_last_name(name);
  if (found) return;
  if (const std::string small = lower_case(name); small != name) return describe(small);
  // What begins like a key is one that is wrong, unless members are called like that.
  const bool begins_a_member = std::ranges::any_of(
      known, [&](const std::string& other) { return other.starts_with(first + "."); });
  if (first != name && !begins_a_member) return print_key(root, name);
  const std::string close = suggestion(name, known);
  throw InputError("nothing is called \"" + name + '"' +
                   (close.starts_with("; did") ? close : "; shoal list shows all names"));
}

}  // namespace shoal::program
