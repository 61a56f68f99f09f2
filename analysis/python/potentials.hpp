#pragma once

#include "shoal/core/setting.hpp"

namespace shoal::python {

/// Whether a Python function of numbers, not of arrays, stands among the options that are chosen.
bool has_scalar_function(const Setting& setting);

}  // namespace shoal::python
