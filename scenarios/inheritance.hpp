#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "shoal/core/setting.hpp"

namespace shoal::scenarios {

/// The key at the top of a scenario under which it names what it inherits.
inline constexpr const char* inherits_key = "inherits";

/// The longest row of files that inherit one another: each holds a copy of all behind it.
inline constexpr std::size_t deepest_inheritance = 32;

/// The most files that one scenario inherits in all. Each counts as often as it is reached: where
/// each of a row names the next one twice, the last is reached 2^n times.
inline constexpr std::size_t most_inherited = 256;

/// TOML files, each read once.
class TomlFiles {
 public:
  /// Throws InputError as read_toml.
  const Setting& at(const std::filesystem::path& file);

 private:
  std::map<std::string, Setting> read_;
};

/// Settings with those that they inherit beneath them.
struct Inheritance {
  Setting settings;                          ///< without the key `inherits`
  std::vector<std::filesystem::path> files;  ///< that were inherited from, also by one another
};

/// Fills in what `inherits = "NAME-or-FILE"`, or a list of them, stands for.
///
/// A setting holds before what is inherited, and of a list the later entries before the earlier.
/// Tables are merged at any depth; everything else, lists of tables among it, is one value: a file
/// that has an [[obstacle]] inherits none. What is inherited may itself inherit. Origins stay those
/// of the files, so that messages and relative files go by where something was written.
///
/// Throws InputError, where it was named, if there is no such set, scenario or file, or if files
/// inherit one another in a circle, in too long a row, or too many.
Inheritance with_inherited(Setting root, TomlFiles& files);

/// Whether what is inherited is named by its file and not as one that ships: it has a folder, or
/// the ending .toml.
bool names_a_file(const std::string& inherited);

/// What a set that ships says of itself: the comment on its first line, "" if there is none.
std::string set_summary(const std::string& name);

/// Throws InputError, where `changes` names what to inherit, if that leaves out a scenario of the
/// library that the settings inherit from: all that it says would be gone. Sets and files, which
/// may be sets, are exchanged.
void require_no_scenario_left_out(const Setting& settings, const Setting& changes);

/// The names in `inherits`. Throws InputError for other values.
std::vector<Setting> inherited_names(const Setting& inherits);

}  // namespace shoal::scenarios
