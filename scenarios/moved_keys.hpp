#pragma once

#include "shoal/core/setting.hpp"

namespace shoal::scenarios {

/// Throws InputError that names the new key if a scenario has one of version 0.1 that was moved.
void require_no_moved_keys(const Setting& root);

}  // namespace shoal::scenarios
