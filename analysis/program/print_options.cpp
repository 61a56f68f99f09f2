#include "print_options.hpp"

#include <fmt/core.h>

#include <cmath>

#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"

namespace shoal::program {
namespace {

std::string value_text(const Setting& value) {
  if (value.is_table() && value.table().empty()) return "none";
  if (const auto* number = std::get_if<double>(&value.value); number && std::isnan(*number)) {
    return "none: to be set";
  }
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

/// `fallback`: nullptr of a family that is chosen in no scenario.
void print_choice(const Option& option, const Setting* fallback, const std::string& key) {
  fmt::print("{}.kind\n    {}; {}one of\n", key, option.meaning,
             fallback ? "default " + value_text(*fallback->find("kind")) + "; " : "");
  for (const MemberInfo& member : option.choice->members()) {
    fmt::print("      {:<26} {}\n", member.name, member.summary);
  }
}

/// Of members that are all in use, those that have options.
void print_members(const Option& option, const std::string& key) {
  fmt::print("{}.NAME.OPTION: {}; those that have some are\n", key, option.meaning);
  for (const MemberInfo& member : option.choice->members()) {
    if (member.schema().options.empty()) continue;
    fmt::print("      {:<26} {}\n", member.name, member.summary);
  }
}

/// With the defaults of where it stands: those of its struct may be others.
void print_entries(const Schema& schema, const Setting& defaults, const std::string& path);

void print_entry(const Option& option, const Setting& fallback, const std::string& key) {
  if (option.table) {
    fmt::print("{}: {}{}\n", key, option.meaning, option.given ? "; may be left out" : "");
    print_entries(*option.table, fallback, key);
  } else if (option.of_all) {
    print_members(option, key);
  } else if (option.choice) {
    print_choice(option, &fallback, key);
  } else {
    print_option(option, fallback, key);
  }
}

void print_entries(const Schema& schema, const Setting& defaults, const std::string& path) {
  for (const Option& option : schema.options) {
    print_entry(option, *defaults.find(option.name), dotted(path, option.name));
  }
}

}  // namespace

void print_schema(const Schema& schema, const std::string& path) {
  print_entries(schema, schema.defaults, path);
}

void print_member(const RegistryBase& family, const MemberInfo& member, const std::string& path) {
  fmt::print("{} ({}): {}\n", member.name, family.family(), member.summary);
  print_schema(member.schema(), path);
}

void print_key(const Schema& schema, const std::string& key) {
  const OptionPlace place = locate(schema, key);
  if (place.is_kind) return print_choice(*place.option, place.fallback, place.key);
  if (place.member) return print_member(*place.option->choice, *place.member, place.key);
  if (!place.fallback) {  // one of the numbers that a user names
    fmt::print("{}\n    {}\n    takes {}\n", place.key, place.option->meaning,
               accepted(*place.option));
    return;
  }
  print_entry(*place.option, *place.fallback, place.key);
}

}  // namespace shoal::program
