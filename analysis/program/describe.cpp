#include <fmt/core.h>

#include <algorithm>

#include "commands.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/core/text.hpp"
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

void print_option(const Option& option, const Setting& fallback, const std::string& key) {
  const bool numeric = option.type == "a number" || option.type == "an integer";
  fmt::print("{}\n    {}\n", key, option.meaning);
  fmt::print("    takes {}{}{}; default {}\n", option.type,
             numeric ? " " + option.range.text() : "", option.unit.empty() ? "" : " " + option.unit,
             value_text(fallback));
}

void print_schema(const Schema& schema, const std::string& path);

void print_entry(const Option& option, const Setting& fallback, const std::string& key) {
  if (option.table) {
    fmt::print("{}: {}\n", key, option.meaning);
    print_schema(*option.table, key);
  } else if (option.choice) {
    fmt::print("{}.kind\n    {}\n    one of {}; default {}\n", key, option.meaning,
               listed(option.choice->names()), value_text(*fallback.find("kind")));
  } else {
    print_option(option, fallback, key);
  }
}

void print_schema(const Schema& schema, const std::string& path) {
  for (const Option& option : schema.options) {
    print_entry(option, *schema.defaults.find(option.name),
                path.empty() ? option.name : path + "." + option.name);
  }
}

void print_member(const RegistryBase& family, const MemberInfo& member, const std::string& path) {
  fmt::print("{} ({}): {}\n", member.name, family.family(), member.summary);
  print_schema(member.schema(), path);
}

/// Walks a dotted key from the scenario's root. Throws InputError at the first unknown part.
void describe_key(const std::string& key) {
  const Schema* schema = &schema_of<scenarios::Scenario>();
  const RegistryBase* choice = nullptr;
  std::string walked;
  const auto parts = split(key, '.');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string part(parts[i]);
    const bool last = i + 1 == parts.size();
    if (choice) {
      if (part == "kind" && last) return print_entry({.name = "", .choice = choice}, {}, walked);
      const MemberInfo& member = choice->members()[choice->index_of(part, {}, walked)];
      walked += "." + part;
      if (last) return print_member(*choice, member, walked);
      schema = &member.schema();
      choice = nullptr;
      continue;
    }
    const Option* option = schema->find(part);
    if (!option) {
      const std::string owner = walked.empty() ? "a scenario" : walked;
      throw InputError(owner + " has no option \"" + part + '"' +
                       suggestion(part, schema->names()));
    }
    walked += (walked.empty() ? "" : ".") + part;
    if (last) return print_entry(*option, *schema->defaults.find(part), walked);
    if (option->choice) {
      choice = option->choice;
    } else if (option->table) {
      schema = option->table;
    } else {
      throw InputError(walked + " is " + option->type + ", so it has no \"" +
                       std::string(parts[i + 1]) + '"');
    }
  }
}

}  // namespace

void describe(const std::string& name) {
  std::vector<std::string> known = schema_of<scenarios::Scenario>().names();
  bool found = false;
  for (const RegistryBase* family : families()) {
    for (const MemberInfo& member : family->members()) {
      known.push_back(member.name);
      if (member.name != name) continue;
      print_member(*family, member, member.name);
      found = true;
    }
  }
  for (const std::string& scenario : scenarios::library_scenarios()) {
    known.push_back(scenario);
    if (scenario != name) continue;
    const auto root = scenarios::read_toml(scenarios::find_scenario(scenario));
    fmt::print("{}", to_toml(scenarios::resolved_scenario(scenarios::read_scenario(root))));
    found = true;
  }
  if (found) return;
  if (name.find('.') == std::string::npos && !schema_of<scenarios::Scenario>().find(name)) {
    throw InputError("nothing is called \"" + name + '"' + suggestion(name, known));
  }
  describe_key(name);
}

}  // namespace shoal::program
