#include "shoal/core/options.hpp"

#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal {

std::string Range::text() const {
  const bool below = std::isfinite(low);
  const bool above = std::isfinite(high);
  if (below && above && low_included) return "from " + shortest(low) + " to " + shortest(high);
  if (below && above) return "above " + shortest(low) + " and at most " + shortest(high);
  if (below) return (low_included ? "at least " : "above ") + shortest(low);
  if (above) return "at most " + shortest(high);
  return "any finite number";
}

std::string Option::range_text() const {
  if (unit.empty()) return range.text();
  const bool unbounded = !std::isfinite(range.low) && !std::isfinite(range.high);
  return range.text() + (unbounded ? ", in " : " ") + unit;
}

const Option* Schema::find(std::string_view name) const {
  for (const Option& option : options) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

std::vector<std::string> Schema::names() const {
  std::vector<std::string> names;
  for (const Option& option : options) names.push_back(option.name);
  return names;
}

void read_options(const Schema& schema, void* object, const Setting& table,
                  const std::string& path) {
  if (!table.is_table()) {
    throw InputError(table.origin, path + " is " + std::string(table.type_name()) +
                                       "; it takes a table of options");
  }
  for (const auto& [name, value] : table.table()) {
    const Option* option = schema.find(name);
    if (!option) {
      const std::string& owner = path.empty() ? schema.noun : path;
      throw InputError(value.origin,
                       owner + " has no option \"" + name + '"' + suggestion(name, schema.names()));
    }
    option->read(object, value, dotted(path, name));
  }
}

Setting write_options(const Schema& schema, const void* object) {
  Setting table;
  for (const Option& option : schema.options) {
    if (option.given && !option.given(object)) continue;
    table.table().emplace_back(option.name, option.write(object));
  }
  return table;
}

namespace detail {

void refuse_type(const Option& option, const Setting& value, const std::string& key) {
  const std::string unit = option.unit.empty() ? "" : " in " + option.unit;
  const auto* text = std::get_if<std::string>(&value.value);
  throw InputError(value.origin, key + " is " + std::string(value.type_name()) +
                                     (text ? " (\"" + *text + "\")" : "") + "; it takes " +
                                     option.type + unit);
}

void require_range(const Option& option, double x, const Setting& value, const std::string& key) {
  if (std::isfinite(x) && option.range.contains(x)) return;
  const auto* integer = std::get_if<std::int64_t>(&value.value);
  throw InputError(value.origin, key + " is " + (integer ? std::to_string(*integer) : shortest(x)) +
                                     "; it takes " + option.range_text());
}

double as_number(const Option& option, const Setting& value, const std::string& key) {
  double x = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&value.value)) {
    x = static_cast<double>(*integer);
  } else if (const auto* number = std::get_if<double>(&value.value)) {
    x = *number;
  } else {
    refuse_type(option, value, key);
  }
  require_range(option, x, value, key);
  return x;
}

std::int64_t as_integer(const Option& option, const Setting& value, const std::string& key) {
  const auto* integer = std::get_if<std::int64_t>(&value.value);
  if (!integer) refuse_type(option, value, key);
  require_range(option, static_cast<double>(*integer), value, key);
  return *integer;
}

const std::string& as_text(const Option& option, const Setting& value, const std::string& key) {
  const auto* text = std::get_if<std::string>(&value.value);
  if (!text) refuse_type(option, value, key);
  return *text;
}

FilePath as_file(const Option& option, const Setting& value, const std::string& key) {
  const std::string& text = as_text(option, value, key);
  if (text.empty() || text.starts_with("library:")) return {text, value.origin};
  std::filesystem::path path = text;
  if (path.is_relative() && value.origin.line > 0) {
    path = std::filesystem::path(value.origin.file).parent_path() / path;
  }
  return {std::filesystem::absolute(path).lexically_normal(), value.origin};
}

const Setting::List& as_list(const Option& option, const Setting& value, const std::string& key) {
  const auto* list = std::get_if<Setting::List>(&value.value);
  if (!list) refuse_type(option, value, key);
  return *list;
}

Eigen::Vector2d as_point(const Option& option, const Setting& value, const std::string& key) {
  const auto* pair = std::get_if<Setting::List>(&value.value);
  if (!pair || pair->size() != 2) refuse_type(option, value, key);
  return {as_number(option, (*pair)[0], key), as_number(option, (*pair)[1], key)};
}

NamedNumbers as_named_numbers(const Option& option, const Setting& value, const std::string& key) {
  if (!value.is_table()) refuse_type(option, value, key);
  NamedNumbers numbers;
  for (const auto& [name, number] : value.table()) {
    numbers.emplace_back(name, as_number(named_number(), number, dotted(key, name)));
  }
  return numbers;
}

Setting::Table written(const NamedNumbers& numbers) {
  Setting::Table table;
  for (const auto& [name, number] : numbers) table.emplace_back(name, plain(number));
  return table;
}

const Option& named_number() {
  static const Option option{
      .name = "", .meaning = "a number under a name of your own", .type = "a number"};
  return option;
}

}  // namespace detail
}  // namespace shoal
