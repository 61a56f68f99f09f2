#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conversions.hpp"
#include "shoal/formations/ping_filter.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::python {

// What planners are given as the argument `name`. They throw InputError, with the name, as those of
// conversions.hpp do.

Eigen::Vector2d place_argument(py::handle value, const std::string& name);  ///< (east, north)
std::optional<Eigen::Vector2d> place_or_none(py::handle value, const std::string& name);

const formations::Plan& plan_argument(py::handle value, const std::string& name);
const formations::Ping& ping_argument(py::handle value, const std::string& name);

bool is_state(py::handle value);  ///< a shoal.OwnState
std::optional<formations::OwnState> state_or_none(py::handle value, const std::string& name);
/// A place stands for a vehicle that rests there.
formations::OwnState state_or_place(py::handle value, const std::string& name);

std::optional<std::string> text_or_none(py::handle value, const std::string& name);
std::vector<std::string> texts_argument(py::handle value, const std::string& name);
/// Of a plan of that size; -1 for a vehicle without an id.
std::vector<int> slots_argument(py::handle value, const std::string& name, int plan_size);
std::vector<Setting> list_of_settings(py::handle value, const std::string& name);

}  // namespace shoal::python
