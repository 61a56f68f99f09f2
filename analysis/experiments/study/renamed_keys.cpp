#include "shoal/analysis/experiments/study/renamed_keys.hpp"

#include <string>

#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

constexpr struct {
  const char* from;
  const char* to;
} renamed_keys[] = {{"metrics", "measures"}, {"metric", "measure"}};

[[noreturn]] void refuse(const std::string& from, const std::string& to, const Origin& origin) {
  throw InputError(origin, from + " is now " + to + "; write that");
}

void require_none_in(const Setting& setting) {
  if (const auto* list = std::get_if<Setting::List>(&setting.value)) {
    for (const Setting& entry : *list) require_none_in(entry);
  }
  if (!setting.is_table()) return;
  for (const auto& [from, to] : renamed_keys) {
    if (const Setting* found = setting.find(from)) refuse(from, to, found->origin);
  }
  if (const Setting* cause = setting.find("cause")) require_none_in(*cause);
}

}  // namespace

void require_no_renamed_keys(const Setting& file) {
  if (!file.is_table()) return;
  for (const char* tables : {"table", "comparison", "sensitivity", "attribution", "claim"}) {
    if (const Setting* found = file.find(tables)) require_none_in(*found);
  }
}

void require_not_renamed(std::string_view key) {
  const std::string_view last = key.substr(key.rfind('.') + 1);  // all, if there is no dot
  for (const auto& [from, to] : renamed_keys) {
    if (last == from) refuse(from, to, {});
  }
}

}  // namespace shoal::analysis
