#pragma once

#include <string_view>

#include "shoal/core/setting.hpp"

namespace shoal::analysis {

/// Throws InputError that names the new key if a study or a file of claims has one of version 0.1
/// that was renamed.
void require_no_renamed_keys(const Setting& file);

/// The same for one key, whatever it stands in: `metrics` or `table.metrics`.
void require_not_renamed(std::string_view key);

}  // namespace shoal::analysis
