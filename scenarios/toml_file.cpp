#include "shoal/scenarios/toml_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "shoal/core/nesting.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/inheritance.hpp"

namespace shoal::scenarios {
namespace {

using OriginOf = std::function<Origin(const toml::source_region&)>;

Setting setting_of(const toml::node& node, const Origin& origin, const OriginOf& origin_of);

/// Names of files end at a NUL, and so do messages.
std::string without_nul(std::string_view text, const Origin& origin) {
  if (text.find('\0') == std::string_view::npos) return std::string(text);
  throw InputError(origin, "a text holds the character NUL (\\u0000); take it out");
}

Setting::Table table_of(const toml::table& table, const OriginOf& origin_of) {
  // toml++ sorts by name; the order of writing is in the positions of the keys.
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::stable_sort(entries, [](const auto& a, const auto& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  Setting::Table settings;
  for (const auto& [key, node] : entries) {
    const Origin origin = origin_of(key->source());
    settings.emplace_back(without_nul(key->str(), origin), setting_of(*node, origin, origin_of));
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
    setting.value = without_nul(text->get(), origin);
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

/// Where the text goes on behind the string or comment that begins at `i`.
std::size_t end_of_text(std::string_view content, std::size_t i) {
  const auto behind = [&](std::string_view end, std::size_t from) {
    const std::size_t found = content.find(end, from);
    return found == std::string_view::npos ? content.size() : found + end.size();
  };
  if (content[i] == '#') return std::min(content.find('\n', i), content.size());
  const std::string_view three = content.substr(i, 3);
  if (three == "\"\"\"" || three == "'''") return behind(three, i + 3);
  for (std::size_t k = i + 1; k < content.size() && content[k] != '\n'; ++k) {
    if (content[k] == '\\' && content[i] == '"') {
      ++k;
    } else if (content[k] == content[i]) {
      return k + 1;
    }
  }
  return content.size();  // not closed: the parser says so
}

/// toml++ limits how deep values are nested, but not the parts of a key (`a.a.a = 1`), whose tables
/// it destroys by recursion. Throws InputError.
void require_shallow_keys(std::string_view content, const std::string& name) {
  std::size_t dots = 0;
  for (std::size_t i = 0; i < content.size();) {
    const char c = content[i];
    const bool is_text = c == '"' || c == '\'' || c == '#';
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
    if (c == '.' && ++dots >= deepest_nesting) {
      const auto line = std::ranges::count(content.substr(0, i), '\n') + 1;
      throw InputError({name, static_cast<int>(line)}, "a key has more than " +
                                                           std::to_string(deepest_nesting) +
                                                           " parts; no option is nested that deep");
    }
    i = is_text ? end_of_text(content, i) : i + 1;
  }
}

/// What stands right of the `=`, or nothing if that is not one TOML value.
std::optional<Setting> toml_value(const std::string& text, const Origin& origin) {
  const bool meant_as_toml = text.find_first_of("[{\"'") == 0;
  if (meant_as_toml) require_shallow_keys(text, origin.file);
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
  const std::optional<std::string> content = read_whole_file(file);
  if (!content) throw InputError({name, 0}, "the file cannot be opened; is there such a file?");
  return parse_toml(*content, name);
}

Setting parse_toml(const std::string& content, const std::string& name) {
  const auto origin_of = [&](const toml::source_region& region) {
    return Origin{name, static_cast<int>(region.begin.line)};
  };
  require_shallow_keys(content, name);
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
  constexpr std::size_t shown = 200;
  const bool whole = assignment.size() <= shown;
  const Origin origin{"--set " + (whole ? assignment : assignment.substr(0, shown) + "..."), 0};
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(origin, "there is no value; write --set KEY=VALUE");
  }
  const std::string key(trimmed(assignment.substr(0, equals)));
  if (key.empty()) throw InputError(origin, "there is no key; write --set KEY=VALUE");
  const std::string text(trimmed(assignment.substr(equals + 1)));

  std::optional<Setting> value = toml_value(text, origin);
  if (!value) value = Setting{text, origin};
  if (key == inherits_key) {
    Setting changes;
    assign(changes, key, *value);
    require_no_scenario_left_out(root, changes);
  }
  Setting* known = root.find_path(key);
  if (known && known->is_table() && value->is_table()) {
    overlay(*known, std::move(*value));
  } else {
    assign(root, key, std::move(*value));
  }
}

}  // namespace shoal::scenarios
