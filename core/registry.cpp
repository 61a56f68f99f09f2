#include "shoal/core/registry.hpp"

#include "shoal/core/text.hpp"

namespace shoal {
namespace {

std::vector<const RegistryBase*>& directory() {
  static std::vector<const RegistryBase*> all;
  return all;
}

}  // namespace

RegistryBase::RegistryBase(std::string family, std::string meaning)
    : family_(std::move(family)), meaning_(std::move(meaning)) {
  directory().push_back(this);
}

std::vector<std::string> RegistryBase::names() const {
  std::vector<std::string> names;
  for (const MemberInfo& member : members_) names.push_back(member.name);
  return names;
}

std::size_t RegistryBase::index_of(std::string_view name, const Origin& origin,
                                   const std::string& key) const {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].name == name) return i;
  }
  throw InputError(origin, (key.empty() ? "" : key + ": ") + "there is no " + family_ + " \"" +
                               std::string(name) + '"' + suggestion(name, names()));
}

std::size_t RegistryBase::insert(MemberInfo info) {
  const auto place = std::ranges::lower_bound(members_, info.name, {}, &MemberInfo::name);
  if (place != members_.end() && place->name == info.name) {
    throw std::logic_error("two members of the family \"" + family_ + "\" are called \"" +
                           info.name + '"');
  }
  const auto index = static_cast<std::size_t>(place - members_.begin());
  members_.insert(place, std::move(info));
  return index;
}

std::vector<const RegistryBase*> families() {
  std::vector<const RegistryBase*> sorted = directory();
  std::ranges::sort(sorted, {}, &RegistryBase::family);
  return sorted;
}

void ChoiceSetting::read(const RegistryBase& registry, const Setting& value,
                         const std::string& key) {
  path = key;
  origin = value.origin;
  if (!value.is_table()) {
    throw InputError(value.origin, key + " is " + std::string(value.type_name()) +
                                       "; it takes a table: " + key + ".kind = \"...\"");
  }
  if (const Setting* given = value.find("kind")) {
    const auto* name = std::get_if<std::string>(&given->value);
    if (!name) {
      throw InputError(given->origin,
                       key + ".kind is " + std::string(given->type_name()) + "; it takes a string");
    }
    registry.index_of(*name, given->origin, key + ".kind");
    kind = *name;
    origin = given->origin;
  }
  for (const auto& [name, table] : value.table()) {
    if (name == "kind") continue;
    const auto names = registry.names();
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      std::vector<std::string> known = names;
      known.emplace_back("kind");
      throw InputError(table.origin,
                       key + " has no option \"" + name + '"' + suggestion(name, known));
    }
    registry.members()[static_cast<std::size_t>(found - names.begin())].check(table,
                                                                              key + "." + name);
    tables.at_or_new(name) = table;
  }
  // A kind without a table has all its defaults; its complaints point at the choice.
  tables.origin = origin;
  tables.at_or_new(kind);
}

Setting ChoiceSetting::write(const RegistryBase& registry) const {
  Setting table;
  table.at_or_new("kind").value = kind;
  for (const MemberInfo& member : registry.members()) {
    const Setting* given = tables.find(member.name);
    if (member.name != kind && !given) continue;
    const Setting complete = member.complete(given ? *given : Setting{}, path + "." + member.name);
    if (!complete.table().empty()) table.at_or_new(member.name) = complete;
  }
  return table;
}

const Setting& ChoiceSetting::options() const {
  static const Setting none;
  const Setting* given = tables.find(kind);
  return given ? *given : none;
}

}  // namespace shoal
