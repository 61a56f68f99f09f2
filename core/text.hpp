#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal {

/// `; did you mean "x"?` with the closest known name, or those that go on behind a dot where the
/// wrong one ends, or the list of all if none is close.
std::string suggestion(std::string_view wrong, std::span<const std::string> known);

/// The shortest decimal that reads back as the same number: `0.1`, `300`, `1e-05`.
std::string shortest(double number);

/// `path.name`, or the name alone where there is no path.
std::string dotted(const std::string& path, const std::string& name);

/// `a, b and c`.
std::string listed(std::span<const std::string> words);

/// The finite number that the whole text spells (`-2.5`, `+1e3`), or nothing.
std::optional<double> parsed_number(std::string_view text);

/// Where the text stops being UTF-8 (RFC 3629), in bytes; nothing if it is all of it.
std::optional<std::size_t> first_not_utf8(std::string_view text);

std::string_view trimmed(std::string_view text);

std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace shoal
