#pragma once

#include "conversions.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::python {

/// A world as Python sees it, for the time of a call.
class WorldView {
 public:
  explicit WorldView(const scenarios::World& world) : world_(&world) {}

  /// Calls a method with it. The interpreter is held.
  static py::object show(const scenarios::World& world, const py::object& method);

  const scenarios::World& world() const;  ///< Throws InputError after the call.

 private:
  const scenarios::World* world_;
};

void add_world_view(py::module_& module);

}  // namespace shoal::python
