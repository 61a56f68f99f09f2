#pragma once

#include <filesystem>
#include <string>

#include "shoal/core/setting.hpp"

namespace shoal::scenarios {

/// A TOML file as a tree of settings, in the order of writing, each with the file (as the user
/// named it) and its line.
///
/// Throws InputError, with the line, for TOML that is malformed, and for dates and times, which no
/// option takes; and if the file cannot be opened.
Setting read_toml(const std::filesystem::path& file);

/// The same of a text; `name` stands for the file in messages.
Setting parse_toml(const std::string& text, const std::string& name);

/// Puts `key=value`, as given to `--set`, into a tree; a later one overrides an earlier one.
///
/// The key is dotted (`behaviour.kind`). The value is read as TOML (`3`, `true`, `"text"`,
/// `[1, 2]`, `{rows = 2}`); what is no TOML value, and has no opening bracket or quote to say that
/// it should be one, is text as it stands. A table set onto a table replaces the keys it names, at
/// any depth, and leaves the others. Throws InputError if there is no `=` or no usable key, or if
/// the path runs through something that is not a table.
void apply_set(Setting& root, const std::string& assignment);

}  // namespace shoal::scenarios
