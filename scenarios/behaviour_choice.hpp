#pragma once

#include <string>

#include "shoal/core/setting.hpp"

namespace shoal::scenarios {

/// Gives a scenario this behaviour, with what it asks for beside its own options: planning by the
/// clock, a guidance of its kind, and a waypoint 500 m east of the origin if there is none. Throws
/// InputError if no behaviour has that name.
void choose_behaviour(Setting& root, const std::string& kind);

}  // namespace shoal::scenarios
