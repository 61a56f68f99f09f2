#pragma once

#include <functional>
#include <memory>

#include "conversions.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::python {

/// Lets Python take part in a long run: Ctrl-C ends it, `progress` (None, or called with a dict)
/// hears about twice a second how far it is, and a warning says if a cost is called for each number
/// that could be called with arrays. It takes the interpreter, which the caller of the run must not
/// hold, and throws py::error_already_set.
std::unique_ptr<scenarios::Observer> watch(const scenarios::Scenario& scenario,
                                           py::object progress);

/// For an Interruption of work that Python waits for: Ctrl-C ends it. It takes the interpreter,
/// which may be held or not, and throws py::error_already_set.
std::function<void()> python_signals();

}  // namespace shoal::python
