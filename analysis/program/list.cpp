#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::program {
namespace {

void list_scenarios() {
  fmt::print("scenario: an experiment to run\n");
  for (const std::string& name : scenarios::library_scenarios()) fmt::print("  {}\n", name);
}

void list_family(const RegistryBase& family) {
  fmt::print("{}: {}\n", family.family(), family.meaning());
  for (const MemberInfo& member : family.members()) {
    fmt::print("  {:<26} {}\n", member.name, member.summary);
  }
}

}  // namespace

void list(const std::string& wanted) {
  std::vector<std::string> known{"scenario"};
  for (const RegistryBase* family : families()) known.push_back(family->family());
  if (!wanted.empty() && std::ranges::find(known, wanted) == known.end()) {
    throw InputError("there is no family \"" + wanted + '"' + suggestion(wanted, known));
  }
  for (const RegistryBase* family : families()) {
    if (wanted.empty() || family->family() == wanted) list_family(*family);
  }
  if (wanted.empty() || wanted == "scenario") list_scenarios();
}

}  // namespace shoal::program
