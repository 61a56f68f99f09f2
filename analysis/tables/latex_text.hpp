#pragma once

#include <string>

namespace shoal::analysis {

/// A text as LaTeX prints it, with all that it would take for commands or ligatures escaped.
/// Letters beyond ASCII stay as they are: UTF-8 is LaTeX's default since 2018, and it knows those
/// of European languages.
std::string latex_escaped(const std::string& text);

/// `energy (\si{Wh})`. Units are those of shoal: `%`, `deg` and `us` are spelt for siunitx, others
/// printed as they stand.
std::string latex_with_unit(const std::string& header, const std::string& unit);

}  // namespace shoal::analysis
