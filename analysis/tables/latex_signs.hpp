#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::analysis {

/// How LaTeX spells the sign, one character of UTF-8 beyond ASCII (Greek, mathematics,
/// punctuation); nothing if it needs no spelling, or has none.
std::optional<std::string> latex_sign(std::string_view character);

/// The characters of a text for LaTeX that pdflatex does not know, each once, in order.
std::vector<std::string> unknown_to_latex(std::string_view latex);

}  // namespace shoal::analysis
