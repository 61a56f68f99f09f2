#include "shoal/core/setting.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "shoal/core/nesting.hpp"
#include "shoal/core/text.hpp"

namespace shoal {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      constexpr std::string_view digits = "0123456789abcdef";
      out += "\\u00";
      out += digits[code >> 4];
      out += digits[code & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare =
      key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
          std::string::npos &&
      !key.empty();
  return bare ? key : quoted(key);
}

std::string inline_text(const Setting& setting);

struct InlineText {
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(double number) const {
    std::string text = shortest(number);
    // TOML tells floats from integers by their spelling.
    if (text.find_first_of(".ein") == std::string::npos) text += ".0";
    return text;
  }
  std::string operator()(const std::string& text) const { return quoted(text); }
  std::string operator()(const Setting::List& list) const {
    std::string text = "[";
    for (std::size_t i = 0; i < list.size(); ++i) text += (i ? ", " : "") + inline_text(list[i]);
    return text + "]";
  }
  std::string operator()(const Setting::Table& table) const {
    std::string text = "{";
    for (std::size_t i = 0; i < table.size(); ++i) {
      text += (i ? ", " : " ") + key_text(table[i].first) + " = " + inline_text(table[i].second);
    }
    return text + " }";
  }
};

std::string inline_text(const Setting& setting) {
  return std::visit(InlineText{}, setting.value);
}

/// Written as `[[name]]`, entry by entry.
bool is_list_of_tables(const Setting& setting) {
  const auto* list = std::get_if<Setting::List>(&setting.value);
  return list && !list->empty() &&
         std::ranges::all_of(*list, [](const Setting& entry) { return entry.is_table(); });
}

bool has_own_header(const Setting& setting) {
  return setting.is_table() || is_list_of_tables(setting);
}

void write_table(const Setting::Table& table, const std::string& path, std::string& out);

void write_entries(const Setting::Table& table, const std::string& path, std::string& out) {
  for (const auto& [name, entry] : table) {
    if (!has_own_header(entry)) out += key_text(name) + " = " + inline_text(entry) + "\n";
  }
  for (const auto& [name, entry] : table) {
    const std::string below = path.empty() ? key_text(name) : path + "." + key_text(name);
    if (entry.is_table()) write_table(entry.table(), below, out);
    if (!is_list_of_tables(entry)) continue;
    for (const Setting& each : std::get<Setting::List>(entry.value)) {
      out += (out.empty() ? "[[" : "\n[[") + below + "]]\n";
      write_entries(each.table(), below, out);
    }
  }
}

void write_table(const Setting::Table& table, const std::string& path, std::string& out) {
  const bool has_values =
      std::ranges::any_of(table, [](const auto& entry) { return !has_own_header(entry.second); });
  if (!path.empty() && (has_values || table.empty())) {
    out += (out.empty() ? "[" : "\n[") + path + "]\n";
  }
  write_entries(table, path, out);
}

}  // namespace

const Setting* Setting::find(std::string_view name) const {
  if (!is_table()) return nullptr;
  for (const auto& [key, entry] : table()) {
    if (key == name) return &entry;
  }
  return nullptr;
}

Setting* Setting::find(std::string_view name) {
  return const_cast<Setting*>(static_cast<const Setting*>(this)->find(name));
}

const Setting* Setting::find_path(std::string_view dotted_path) const {
  const Setting* place = this;
  for (const std::string_view part : split(dotted_path, '.')) {
    if (place) place = place->find(part);
  }
  return place;
}

Setting* Setting::find_path(std::string_view dotted_path) {
  return const_cast<Setting*>(static_cast<const Setting*>(this)->find_path(dotted_path));
}

Setting& Setting::at_or_new(std::string_view name) {
  if (Setting* found = find(name)) return *found;
  Setting fresh;
  fresh.origin = origin;
  return table().emplace_back(std::string(name), std::move(fresh)).second;
}

std::string_view Setting::type_name() const {
  static constexpr std::array<std::string_view, 6> names{"true or false", "an integer", "a number",
                                                         "a string",      "a list",     "a table"};
  return names[value.index()];
}

void assign(Setting& root, std::string_view dotted_path, Setting value) {
  const std::vector<std::string_view> parts = split(dotted_path, '.');
  if (parts.size() > deepest_nesting) {
    throw InputError(value.origin, "a key has " + std::to_string(parts.size()) +
                                       " parts, but no option is nested deeper than " +
                                       std::to_string(deepest_nesting));
  }
  Setting* place = &root;
  std::string walked;
  for (const std::string_view part : parts) {
    if (part.empty()) {
      throw InputError(value.origin, "\"" + std::string(dotted_path) +
                                         "\" is not a dotted key; write e.g. trial.seed");
    }
    if (!place->is_table()) {
      throw InputError(value.origin, "\"" + walked + "\" is " + std::string(place->type_name()) +
                                         ", so it has no \"" + std::string(part) + "\"");
    }
    const bool known = place->find(part) != nullptr;
    place = &place->at_or_new(part);
    if (!known) place->origin = value.origin;
    walked += (walked.empty() ? "" : ".") + std::string(part);
  }
  *place = std::move(value);
}

void overlay(Setting& place, Setting value) {
  if (!place.is_table() || !value.is_table()) {
    place = std::move(value);
    return;
  }
  for (auto& [name, entry] : value.table()) {
    if (Setting* known = place.find(name)) {
      overlay(*known, std::move(entry));
    } else {
      place.table().emplace_back(name, std::move(entry));
    }
  }
}

std::string to_toml(const Setting& root) {
  std::string out;
  write_table(root.table(), "", out);
  return out;
}

}  // namespace shoal
