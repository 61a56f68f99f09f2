#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "commands.hpp"
#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

void list_scenarios() {
  fmt::print("scenario: an experiment to run\n");
  for (const std::string& name : scenarios::library_scenarios()) fmt::print("  {}\n", name);
}

void list_sets() {
  fmt::print("set: settings that a scenario inherits, or takes by --set inherits=NAME\n");
  for (const std::string& name : scenarios::library_sets()) {
    fmt::print("  {:<26} {}\n", name, scenarios::set_summary(name));
  }
}

void list_quantities(const std::vector<analysis::Quantity>& quantities, const char* what) {
  fmt::print("    {}\n", what);
  for (const analysis::Quantity& each : quantities) {
    fmt::print("      {:<38} {:<5} {}\n", each.name, each.unit, each.meaning);
  }
}

/// Measures have no options; what they yield is what studies name.
void list_measures(const RegistryBase& family) {
  fmt::print("{}: {}\n", family.family(), family.meaning());
  for (const MemberInfo& member : family.members()) {
    fmt::print("  {:<26} {}\n", member.name, member.summary);
    const auto measure =
        Registry<analysis::Measure>::instance().make(member.name, Setting{}, member.name);
    list_quantities(measure->values(), "values");
    if (!measure->series().empty()) list_quantities(measure->series(), "series");
  }
}

void list_family(const RegistryBase& family) {
  fmt::print("{}: {}\n", family.family(), family.meaning());
  for (const MemberInfo& member : family.members()) {
    fmt::print("  {:<26} {}\n", member.name, member.summary);
  }
}

void list_studies() {
  fmt::print("study: trials of a scenario with what is varied, its tables and claims\n");
  for (const std::string& name : analysis::library_studies()) {
    const Setting root = scenarios::read_toml(analysis::find_study(name));
    fmt::print("  {:<26} {}\n", name, analysis::read_study(root).title);
  }
}

/// `solvers`, `losses`, `studies`: what one also calls the family of a solver, of a loss.
std::string plural(const std::string& family) {
  if (family.ends_with('y')) return family.substr(0, family.size() - 1) + "ies";
  return family + (family.ends_with('s') ? "es" : "s");
}

bool is_asked_for(const std::string& family, const std::string& wanted) {
  return wanted == family || wanted == plural(family);
}

}  // namespace

bool is_listed(const std::string& wanted) {
  return std::ranges::any_of(
             families(),
             [&](const RegistryBase* family) { return is_asked_for(family->family(), wanted); }) ||
         std::ranges::any_of(std::array{"scenario", "set", "study"},
                             [&](const char* family) { return is_asked_for(family, wanted); });
}

void list(const std::string& wanted) {
  std::vector<std::string> known;
  bool found = false;
  const auto asked_for = [&](const std::string& family) {
    known.push_back(family);
    const bool asked = wanted.empty() || is_asked_for(family, wanted);
    found |= asked;
    return asked;
  };
  for (const RegistryBase* family : families()) {
    if (!asked_for(family->family())) continue;
    const bool measures = family->family() == analysis::Measure::family;
    measures ? list_measures(*family) : list_family(*family);
  }
  if (asked_for("scenario")) list_scenarios();
  if (asked_for("set")) list_sets();
  if (asked_for("study")) list_studies();
  if (!found) throw InputError("there is no family \"" + wanted + '"' + suggestion(wanted, known));
}

}  // namespace shoal::program
