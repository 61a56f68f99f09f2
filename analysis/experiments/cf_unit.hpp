#pragma once

#include <string>

namespace shoal::analysis {

/// A declared unit as UDUNITS, and so CF, spells it; "1" for a pure number.
std::string cf_unit(const std::string& unit);

}  // namespace shoal::analysis
