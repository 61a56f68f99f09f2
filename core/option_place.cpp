#include "shoal/core/option_place.hpp"

#include "shoal/core/text.hpp"

namespace shoal {

OptionPlace locate(const Schema& root, const std::string& key, const Origin& origin) {
  const Schema* schema = &root;
  const Option* choice = nullptr;  // set behind an option that is one, until a member is named
  OptionPlace place;
  const auto parts = split(key, '.');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string part(parts[i]);
    if (choice && !choice->of_all && part == "kind" && i + 1 == parts.size()) {
      place.is_kind = true;
      break;
    }
    if (choice) {
      const RegistryBase& family = *choice->choice;
      std::string name = part;
      while (!family.find(name) && family.has_below(name) && i + 1 < parts.size()) {
        name += "." + std::string(parts[++i]);
      }
      place.member = &family.members()[family.index_of(name, origin, place.key)];
      place.key += "." + name;
      schema = &place.member->schema();
      choice = nullptr;
      continue;
    }
    const Option* option = schema->find(part);
    if (!option) {
      const std::string& owner = place.key.empty() ? schema->noun : place.key;
      throw InputError(
          origin, owner + " has no option \"" + part + '"' + suggestion(part, schema->names()));
    }
    place.option = option;
    place.member = nullptr;
    place.key = dotted(place.key, part);
    place.fallback = schema->defaults.find(part);
    choice = option->choice ? option : nullptr;
    if (option->table) {
      schema = option->table;
    } else if (option->entry && i + 2 == parts.size()) {
      place.key += "." + std::string(parts[++i]);
      place.option = option->entry;
      place.fallback = nullptr;
    } else if (!choice && i + 1 < parts.size()) {
      throw InputError(origin, place.key + " is " + option->type + ", so it has no \"" +
                                   std::string(parts[i + 1]) + '"');
    }
  }
  return place;
}

void visit_options(const Schema& schema, Setting& written,
                   const std::function<void(const Option&, Setting& value)>& visitor) {
  for (const Option& option : schema.options) {
    Setting* value = written.find(option.name);
    if (!value) continue;
    if (option.table) {
      visit_options(*option.table, *value, visitor);
      continue;
    }
    visitor(option, *value);
    if (!option.choice) continue;
    for (const MemberInfo& member : option.choice->members()) {
      if (Setting* table = value->find_path(member.name)) {
        visit_options(member.schema(), *table, visitor);
      }
    }
  }
}

}  // namespace shoal
