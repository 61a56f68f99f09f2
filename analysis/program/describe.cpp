#include <fmt/core.h>

#include <algorithm>

#include "commands.hpp"
#include "shoal/analysis/measure.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

std::string value_text(const Setting& value) {
  Setting table;
  table.at_or_new("x") = value;
  const std::string text = to_toml(table);
  return std::string(trimmed(text.substr(text.find('=') + 1)));
}

std::string accepted(const Option& option) {
  const std::string range = option.range_text();
  if (option.type == "a number" && range.starts_with("any")) return range;
  if (option.type == "a number" || option.type == "an integer") return option.type + " " + range;
  return option.type + (option.unit.empty() ? "" : " in " + option.unit);
}

void print_option(const Option& option, const Setting& fallback, const std::string& key) {
  fmt::print("{}\n    {}\n    takes {}; default {}\n", key, option.meaning, accepted(option),
             value_text(fallback));
}

void print_choice(const Option& option, const Setting& fallback, const std::string& key) {
  fmt::print("{}.kind\n    {}; default {}; one of\n", key, option.meaning,
             value_text(*fallback.find("kind")));
  for (const MemberInfo& member : option.choice->members()) {
    fmt::print("      {:<26} {}\n", member.name, member.summary);
  }
}

/// With the defaults of where it stands: those of its struct may be others.
void print_schema(const Schema& schema, const Setting& defaults, const std::string& path);

void print_entry(const Option& option, const Setting& fallback, const std::string& key) {
  if (option.table) {
    fmt::print("{}: {}\n", key, option.meaning);
    print_schema(*option.table, fallback, key);
  } else if (option.choice) {
    print_choice(option, fallback, key);
  } else {
    print_option(option, fallback, key);
  }
}

void print_schema(const Schema& schema, const Setting& defaults, const std::string& path) {
  for (const Option& option : schema.options) {
    print_entry(option, *defaults.find(option.name), dotted(path, option.name));
  }
}

void print_member(const RegistryBase& family, const MemberInfo& member, const std::string& path) {
  fmt::print("{} ({}): {}\n", member.name, family.family(), member.summary);
  print_schema(member.schema(), member.schema().defaults, path);
}

/// Throws InputError at the first unknown part of the key.
void describe_key(const std::string& key) {
  const OptionPlace place = locate(schema_of<scenarios::Scenario>(), key);
  if (place.is_kind) return print_choice(*place.option, *place.fallback, place.key);
  if (place.member) return print_member(*place.option->choice, *place.member, place.key);
  print_entry(*place.option, *place.fallback, place.key);
}

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
bool describe_set(const std::string& name, std::vector<std::string>& known) {
  const std::vector<std::string> names = scenarios::library_sets();
  known.insert(known.end(), names.begin(), names.end());
  if (std::ranges::find(names, name) == names.end()) return false;
  fmt::print("{}", read_whole_file(scenarios::set_file(name)).value());
  return true;
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

}  // namespace

void describe(const std::string& name) {
  const Schema& root = schema_of<scenarios::Scenario>();
  const std::string first = name.substr(0, name.find('.'));
  bool found = root.find(first) != nullptr;
  if (found) describe_key(name);
  std::vector<std::string> known = root.names();
  found |= describe_members(name, known);
  found |= describe_quantities(name, known);
  found = found || describe_scenario(name, known);
  found = found || describe_set(name, known);
  found = found || describe_inherits(name, known);
  if (found) return;
  // What begins like a key is one that is wrong, unless members are called like that.
  const bool begins_a_member = std::ranges::any_of(
      known, [&](const std::string& other) { return other.starts_with(first + "."); });
  if (first != name && !begins_a_member) return describe_key(name);
  const std::string close = suggestion(name, known);
  throw InputError("nothing is called \"" + name + '"' +
                   (close.starts_with("; did") ? close : "; shoal list shows all names"));
}

}  // namespace shoal::program
