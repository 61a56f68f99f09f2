#include "shoal/core/registry.hpp"

#include "shoal/core/text.hpp"

namespace shoal {
namespace {

std::vector<const RegistryBase*>& directory() {
  static std::vector<const RegistryBase*> all;
  return all;
}

/// What may be written after `prefix` (dotted, or empty): the rest of every member's name.
std::vector<std::string> names_below(const RegistryBase& registry, const std::string& prefix) {
  std::vector<std::string> rests;
  for (const MemberInfo& member : registry.members()) {
    if (member.name.starts_with(prefix)) rests.push_back(member.name.substr(prefix.size()));
  }
  return rests;
}

/// Also the first parts of dotted names (`nlopt`) may be what was meant, but the list of what is
/// known names members only.
std::string suggested_name(const std::string& wrong, const std::vector<std::string>& names) {
  std::vector<std::string> parts = names;
  for (const std::string& name : names) parts.push_back(name.substr(0, name.find('.')));
  const std::string close = suggestion(wrong, parts);
  return close.starts_with("; did") ? close : suggestion(wrong, names);
}

/// Puts the tables of members, checked, into `tables` under their whole names. `prefix` is the
/// part of those names that `value` stands for: `nlopt.` or nothing. `kind` beside them chooses
/// one, if one is chosen.
void gather(const RegistryBase& registry, const Setting& value, const std::string& key,
            const std::string& prefix, bool chosen, Setting& tables) {
  const std::string path = key + (prefix.empty() ? "" : "." + prefix.substr(0, prefix.size() - 1));
  for (const auto& [part, entry] : value.table()) {
    if (part == "kind" && prefix.empty() && chosen) continue;
    const std::string name = prefix + part;
    if (const MemberInfo* member = registry.find(name)) {
      // `"nlopt.lbfgs"` beside `nlopt.lbfgs` would be two tables for one member.
      if (part.find('.') != std::string::npos) {
        throw InputError(entry.origin, path + " has no option \"" + part + "\"; write " + path +
                                           "." + part + " without quotes");
      }
      member->check(entry, path + "." + part);
      tables.at_or_new(name) = entry;
    } else if (!registry.has_below(name)) {
      std::vector<std::string> known = names_below(registry, prefix);
      if (prefix.empty() && chosen) known.emplace_back("kind");
      throw InputError(entry.origin,
                       path + " has no option \"" + part + '"' + suggested_name(part, known));
    } else if (!entry.is_table()) {
      throw InputError(entry.origin, path + "." + part + " is " + std::string(entry.type_name()) +
                                         "; it takes a table of options");
    } else {
      gather(registry, entry, key, name + ".", chosen, tables);
    }
  }
}

std::string key_of(const RegistryBase& family, const Schema& schema, const std::string& path,
                   std::vector<const RegistryBase*>& walked) {
  for (const Option& option : schema.options) {
    const std::string key = dotted(path, option.name);
    if (option.choice == &family) return key;
    if (option.table) {
      const std::string deeper = key_of(family, *option.table, key, walked);
      if (!deeper.empty()) return deeper;
    }
    // Members may choose from their own family: a family that was walked once has nothing new.
    if (!option.choice || std::ranges::find(walked, option.choice) != walked.end()) continue;
    walked.push_back(option.choice);
    for (const MemberInfo& member : option.choice->members()) {
      const std::string deeper = key_of(family, member.schema(), key + "." + member.name, walked);
      if (!deeper.empty()) return deeper;
    }
  }
  return "";
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

const MemberInfo* RegistryBase::find(std::string_view name) const {
  const auto found = std::ranges::find(members_, name, &MemberInfo::name);
  return found == members_.end() ? nullptr : &*found;
}

const MemberInfo& RegistryBase::of_type(const std::type_info& type) const {
  const auto is_it = [&](const MemberInfo& member) { return member.type && *member.type == type; };
  const auto found = std::ranges::find_if(members_, is_it);
  if (found != members_.end() && std::none_of(found + 1, members_.end(), is_it)) return *found;
  throw std::logic_error("the family \"" + family_ + "\" has " +
                         (found == members_.end() ? "no member" : "several members") +
                         " with options of the type " + type.name() + "; choose by name");
}

bool RegistryBase::has_below(std::string_view name) const {
  const std::string prefix = std::string(name) + ".";
  return std::ranges::any_of(
      members_, [&](const MemberInfo& member) { return member.name.starts_with(prefix); });
}

std::size_t RegistryBase::index_of(std::string_view name, const Origin& origin,
                                   const std::string& key) const {
  const std::string where = key.empty() ? "" : key + ": ";
  const MemberInfo* found = find(name);
  if (!found) {
    throw InputError(origin, where + "there is no " + family_ + " \"" + std::string(name) + '"' +
                                 suggestion(name, names()));
  }
  if (!found->left_out_by.empty()) {
    throw InputError(origin, where + "the " + family_ + " \"" + found->name +
                                 "\" was left out of this build; configure it with -D" +
                                 found->left_out_by + "=ON");
  }
  return static_cast<std::size_t>(found - members_.data());
}

std::optional<std::size_t> RegistryBase::replace(MemberInfo info) {
  const auto found = std::ranges::find(members_, info.name, &MemberInfo::name);
  if (found == members_.end()) return std::nullopt;
  *found = std::move(info);
  ++generation_;
  return static_cast<std::size_t>(found - members_.begin());
}

std::size_t RegistryBase::insert(MemberInfo info) {
  ++generation_;
  const auto place = std::ranges::lower_bound(members_, info.name, {}, &MemberInfo::name);
  if (place != members_.end() && place->name == info.name) {
    throw std::logic_error("two members of the family \"" + family_ + "\" are called \"" +
                           info.name + '"');
  }
  for (const MemberInfo& member : members_) {
    if (member.name.starts_with(info.name + ".") || info.name.starts_with(member.name + ".")) {
      throw std::logic_error("the options of \"" + member.name + "\" and \"" + info.name +
                             "\" of the family \"" + family_ + "\" would mix in one table");
    }
  }
  const auto index = static_cast<std::size_t>(place - members_.begin());
  members_.insert(place, std::move(info));
  return index;
}

namespace {
thread_local RegistryWatch* watching = nullptr;
}  // namespace

RegistryWatch::RegistryWatch() {
  watching = this;
}

RegistryWatch::~RegistryWatch() {
  watching = nullptr;
}

void RegistryWatch::add(const std::function<void()>& registration) {
  if (!watching) return registration();
  try {
    registration();
  } catch (const std::exception& error) {
    if (watching->failure_.empty()) watching->failure_ = error.what();
  }
}

std::vector<const RegistryBase*> families() {
  std::vector<const RegistryBase*> sorted = directory();
  std::ranges::sort(sorted, {}, &RegistryBase::family);
  return sorted;
}

const RegistryBase* family_named(std::string_view name) {
  const std::vector<const RegistryBase*> all = families();
  const auto found = std::ranges::find(all, name, &RegistryBase::family);
  return found == all.end() ? nullptr : *found;
}

std::string key_of(const RegistryBase& family, const Schema& schema) {
  std::vector<const RegistryBase*> walked;
  return key_of(family, schema, "", walked);
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
  gather(registry, value, key, "", true, tables);
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
    if (!complete.table().empty()) assign(table, member.name, complete);
  }
  return table;
}

const Setting& ChoiceSetting::options() const {
  static const Setting none;
  const Setting* given = tables.find(kind);
  return given ? *given : none;
}

void MemberOptions::read(const RegistryBase& registry, const Setting& value,
                         const std::string& key) {
  if (!value.is_table()) {
    throw InputError(value.origin, key + " is " + std::string(value.type_name()) +
                                       "; it takes a table with a table for each member");
  }
  gather(registry, value, key, "", false, tables);
}

Setting MemberOptions::write(const RegistryBase& registry) const {
  Setting table;
  for (const MemberInfo& member : registry.members()) {
    const Setting* given = tables.find(member.name);
    if (!given) continue;
    const Setting complete = member.complete(*given, registry.family() + "." + member.name);
    if (!complete.table().empty()) assign(table, member.name, complete);
  }
  return table;
}

const Setting& MemberOptions::of(std::string_view name) const {
  static const Setting none;
  const Setting* given = tables.find(name);
  return given ? *given : none;
}

}  // namespace shoal
