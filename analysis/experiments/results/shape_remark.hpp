#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal::analysis {

/// What a note says of a sample that its mean does not describe: `Two kinds: 17 of 20 at 42.1, 3 of
/// 20 at 121.`; nothing of others. The rule is that of note_on_shapes().
std::optional<std::string> remark_on_shape(const std::vector<double>& values);

/// How samples are chosen that get a remark.
std::string note_on_shapes();

}  // namespace shoal::analysis
