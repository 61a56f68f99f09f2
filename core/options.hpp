#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shoal/core/setting.hpp"

namespace shoal {

class RegistryBase;
struct MemberOptions;
struct Schema;

/// The numbers an option may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;

  bool contains(double x) const { return (low_included ? x >= low : x > low) && x <= high; }
  std::string text() const;
};
inline Range in(double low, double high) {
  return {low, high, true};
}
inline Range above(double low) {
  return {low, std::numeric_limits<double>::infinity(), false};
}
inline Range at_least(double low) {
  return {low, std::numeric_limits<double>::infinity(), true};
}

/// A file named in a setting: relative to the file that names it, or to where the user stands when
/// it came from the command line. `library:x` means x among the files that ship with shoal.
struct FilePath {
  std::filesystem::path path;
  Origin origin;  ///< where it was named, for messages
};

/// Numbers under names that a user chooses, in the order of writing.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// One declared option of a struct, with the types erased.
///
/// From it follow reading with line-numbered errors, `--set`, `shoal describe` and the resolved
/// scenario; a parameter is written down nowhere else.
struct Option {
  std::string name;
  std::string unit;      ///< "" for a pure number
  std::string meaning;   ///< one line
  std::string type;      ///< "a number", "one of ..." ..., for messages
  bool is_file = false;  ///< the value names a file
  Range range;
  const Schema* table = nullptr;         ///< set for a nested struct
  const Option* entry = nullptr;         ///< set for a table of named numbers: what each of them is
  const RegistryBase* choice = nullptr;  ///< set for a member of a family
  bool of_all = false;  ///< of that family none is chosen: each member has a table of its name
  std::function<void(void* object, const Setting&, const std::string& key)> read;
  std::function<Setting(const void* object)> write;
  std::function<bool(const void* object)> given;  ///< of one that may be left out; or empty

  /// The range with its unit: `from 0 to 180 deg`.
  std::string range_text() const;
};

/// All options of one struct, and their defaults: those of a value-initialised struct, and of a
/// table that was left out there, what it has where it is given.
struct Schema {
  std::vector<Option> options;
  Setting defaults;
  std::string noun;  ///< what the struct as a whole is called in messages: "a scenario"

  const Option* find(std::string_view name) const;
  std::vector<std::string> names() const;
};

/// Fills `object` from a table. Throws InputError for unknown names (with a suggestion), wrong
/// types and values out of range. `path` is the dotted name of the table, "" for the root.
void read_options(const Schema& schema, void* object, const Setting& table,
                  const std::string& path);

/// Every option of `object`, also those that were not set, but no table that was left out.
Setting write_options(const Schema& schema, const void* object);

template <class Family>
class Choice;

/// Declares the options of `T`: every option once, with its unit, range and meaning.
///
///     static void declare(Options<Drift>& o) {
///       o.number("speed_m_s", &Drift::speed_m_s, "m/s", in(0, 5), "transit speed");
///     }
template <class T>
class Options {
 public:
  void number(std::string name, double T::*member, std::string unit, Range range,
              std::string meaning);
  void integer(std::string name, std::int64_t T::*member, std::string unit, Range range,
               std::string meaning);
  void flag(std::string name, bool T::*member, std::string meaning);
  void text(std::string name, std::string T::*member, std::string meaning);
  void file(std::string name, FilePath T::*member, std::string meaning);
  void texts(std::string name, std::vector<std::string> T::*member, std::string meaning);
  void numbers(std::string name, std::vector<double> T::*member, std::string unit, Range range,
               std::string meaning);
  void points(std::string name, std::vector<Eigen::Vector2d> T::*member, std::string meaning,
              std::string unit = "m");
  /// `name = { a = 1, b = 0.5 }`, or one by one: `name.a = 1`.
  void named_numbers(std::string name, NamedNumbers T::*member, std::string meaning);

  /// One of a few words, each with its enumerator.
  template <class Enum>
  void word(std::string name, Enum T::*member,
            std::initializer_list<std::pair<std::string, Enum>> words, std::string meaning);

  /// A nested declared struct.
  template <class Nested>
  void table(std::string name, Nested T::*member, std::string meaning);

  /// A nested declared struct that may be left out.
  template <class Nested>
  void table(std::string name, std::optional<Nested> T::*member, std::string meaning);

  /// Any number of declared structs: `[[name]]` in a file.
  template <class Nested>
  void tables(std::string name, std::vector<Nested> T::*member, std::string meaning);

  /// A value whose form is checked elsewhere; `type` says what it takes, for messages.
  void setting(std::string name, Setting T::*member, std::string type, std::string meaning);

  /// A member of a family: `name.kind = "x"`, its options in the table `name.x`.
  template <class Family>
  void choice(std::string name, Choice<Family> T::*member, std::string meaning);

  /// Options of members of a family that are all in use: `name.member.option = value`.
  void members(std::string name, MemberOptions T::*member, const RegistryBase& family,
               std::string meaning);

  std::vector<Option> take() { return std::move(options_); }

 private:
  template <class Value, class Read, class Write>
  void add(Option option, Value T::*member, Read read, Write write);

  std::vector<Option> options_;
};

/// The schema of a declared struct.
template <class T>
const Schema& schema_of();

/// Reads a declared struct; a member `std::optional<std::string> complaint() const`, if there is
/// one, says what is wrong with values that are each in range but do not go together. A member
/// `Origin origin`, if there is one, keeps where the table was written, for later messages.
template <class T>
void read(T& object, const Setting& table, const std::string& path);

}  // namespace shoal

#include "shoal/core/options_impl.hpp"
