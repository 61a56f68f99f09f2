#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shoal/core/error.hpp"

namespace shoal {

/// A value as it was written, and where: the neutral form between files, `--set` and structs.
///
/// Tables keep the order of writing. Values written by hand and by the program are alike.
struct Setting {
  using List = std::vector<Setting>;
  /// A class of its own: of a variant of nothing but std::vector and the like, libstdc++ 12
  /// destroys an alternative that was never made, if memory ends while the variant is copied.
  struct Table : std::vector<std::pair<std::string, Setting>> {
    using vector::vector;
  };

  std::variant<bool, std::int64_t, double, std::string, List, Table> value = Table{};
  Origin origin;

  bool is_table() const { return std::holds_alternative<Table>(value); }
  Table& table() { return std::get<Table>(value); }
  const Table& table() const { return std::get<Table>(value); }

  /// The entry of a table, or nullptr if there is none (or this is no table).
  const Setting* find(std::string_view name) const;
  Setting* find(std::string_view name);

  /// What stands at a dotted path (`behaviour.kind`), or nullptr.
  const Setting* find_path(std::string_view dotted_path) const;
  Setting* find_path(std::string_view dotted_path);

  /// The entry of a table, made (with this origin) if there is none yet.
  Setting& at_or_new(std::string_view name);

  /// "a number", "a table" ...: what the value is, for messages.
  std::string_view type_name() const;
};

/// Puts `value` at a dotted path (`behaviour.kind`), making the tables on the way.
/// Throws InputError when the path runs through something that is not a table.
void assign(Setting& root, std::string_view dotted_path, Setting value);

/// Puts a value over another: of two tables the names that `value` has, at any depth, and the
/// others stay; anything else is replaced.
void overlay(Setting& place, Setting value);

/// The tree as TOML text: values of a table first, sub-tables after them.
std::string to_toml(const Setting& root);

}  // namespace shoal
