#include "shoal/scenarios/toml_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

using OriginOf = std::function<Origin(const toml::source_region&)>;

Setting setting_of(const toml::node& node, const Origin& origin, const OriginOf& origin_of);

Setting::Table table_of(const toml::table& table, const OriginOf& origin_of) {
  // toml++ sorts by name; the order of writing is in the positions of the keys.
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::stable_sort(entries, [](const auto& a, const auto& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  Setting::Table settings;
  for (const auto& [key, node] : entries) {
    settings.emplace_back(std::string(key->str()),
                          setting_of(*node, origin_of(key->source()), origin_of));
  }
  return settings;
}

Setting setting_of(const toml::node& node, const Origin& origin, const OriginOf& origin_of) {
  Setting setting;
  setting.origin = origin;
  if (const auto* table = node.as_table()) {
    setting.value = table_of(*table, origin_of);
  } else if (const auto* array = node.as_array()) {
    Setting::List list;
    for (const toml::node& entry : *array) {
      list.push_back(setting_of(entry, origin_of(entry.source()), origin_of));
    }
    setting.value = std::move(list);
  } else if (const auto* text = node.as_string()) {
    setting.value = text->get();
  } else if (const auto* integer = node.as_integer()) {
    setting.value = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    setting.value = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    setting.value = flag->get();
  } else {
    throw InputError(origin, "no option takes a TOML date or time; write seconds, or quoted text");
  }
  return setting;
}

/// What stands right of the `=`, or nothing if that is not one TOML value.
std::optional<Setting> toml_value(const std::string& text, const Origin& origin) {
  const bool meant_as_toml = text.find_first_of("[{\"'") == 0;
  try {
    const toml::table parsed = toml::parse("value = " + text);
    const toml::node* node = parsed.get("value");
    if (parsed.size() == 1 && (!node->is_date() && !node->is_time() && !node->is_date_time())) {
      return setting_of(*node, origin, [&](const toml::source_region&) { return origin; });
    }
  } catch (const toml::parse_error& wrong) {
    if (meant_as_toml)
      throw InputError(origin, "not a TOML value: " + std::string(wrong.description()));
  }
  return std::nullopt;
}

}  // namespace

Setting read_toml(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (std::filesystem::is_directory(file)) {
    throw InputError({name, 0}, "this is a directory; name a TOML file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError({name, 0}, "the file cannot be opened; is there such a file?");
  return parse_toml({std::istreambuf_iterator<char>(in), {}}, name);
}

Setting parse_toml(const std::string& content, const std::string& name) {
  const auto origin_of = [&](const toml::source_region& region) {
    return Origin{name, static_cast<int>(region.begin.line)};
  };
  try {
    Setting root;
    root.origin = {name, 0};
    root.value = table_of(toml::parse(content, name), origin_of);
    return root;
  } catch (const toml::parse_error& wrong) {
    throw InputError(origin_of(wrong.source()),
                     "this is not TOML: " + std::string(wrong.description()));
  }
}

void apply_set(Setting& root, const std::string& assignment) {
  const Origin origin{"--set " + assignment, 0};
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(origin, "there is no value; write --set KEY=VALUE");
  }
  const std::string key(trimmed(assignment.substr(0, equals)));
  if (key.empty()) throw InputError(origin, "there is no key; write --set KEY=VALUE");
  const std::string text(trimmed(assignment.substr(equals + 1)));

  std::optional<Setting> value = toml_value(text, origin);
  if (!value) value = Setting{text, origin};
  Setting* known = root.find_path(key);
  if (known && known->is_table() && value->is_table()) {
    overlay(*known, std::move(*value));
  } else {
    assign(root, key, std::move(*value));
  }
}

}  // namespace shoal::scenarios
