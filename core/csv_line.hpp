#pragma once

#include <string>
#include <vector>

namespace shoal {

/// A line of a CSV file, with its end; fields are quoted where RFC 4180 (section 2) asks for it.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace shoal
