#pragma once

#include "shoal/core/setting.hpp"

namespace shoal::analysis {

/// Throws InputError that names the new key if a study or a file of claims has one of version 0.1
/// that was renamed.
void require_no_renamed_keys(const Setting& file);

}  // namespace shoal::analysis
