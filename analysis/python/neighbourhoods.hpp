#pragma once

#include <span>

#include "conversions.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::python {

/// What a vehicle knows, as a Neighbourhood of Python. The interpreter is held, and the plan lives
/// on.
py::object one_neighbourhood(const formations::Neighbourhood& seen, const formations::Plan& plan);

/// What several vehicles know, as Neighbourhoods of Python.
py::object many_neighbourhoods(std::span<const formations::Neighbourhood> seen,
                               const formations::Plan& plan);

}  // namespace shoal::python
