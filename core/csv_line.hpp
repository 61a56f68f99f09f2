#pragma once

#include <string>
#include <vector>

namespace shoal {

/// A line of a CSV file, with its end; fields are quoted where RFC 4180 (section 2) asks for it. A
/// text that a spreadsheet would take for a formula (it begins with = + - or @, perhaps behind
/// blanks and quotes) gets the apostrophe that marks it as text; numbers stay as they are.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace shoal
