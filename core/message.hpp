#pragma once

#include <string_view>

namespace shoal {

/// Writes to stderr what is for people to read: complaints, progress. That nothing may be written
/// there (a full disk, a terminal that is gone) is no reason to end the work, and is ignored.
void write_message(std::string_view text);

}  // namespace shoal
