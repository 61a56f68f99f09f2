#pragma once

#include <string_view>

#include "shoal/core/setting.hpp"

namespace shoal::scenarios {

/// Throws InputError that names the new key if a scenario has one of version 0.1 that was moved.
void require_no_moved_keys(const Setting& root);

/// The same for one dotted key, or what stands below it.
void require_not_moved(std::string_view key, const Origin& origin);

}  // namespace shoal::scenarios
