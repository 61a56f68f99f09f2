#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <vector>

#include "shoal/core/setting.hpp"

namespace shoal::python {

namespace py = pybind11;

/// A dict as a tree of settings: keys may be dotted, later ones go over earlier ones. Takes bool,
/// int, float, str, paths, numpy's numbers, sequences, dicts, and what has a method `_setting_`.
/// Throws InputError for anything else.
Setting to_setting(py::handle value);

py::object to_python(const Setting& setting);

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// What a Python function returned, `what` in messages. Throws InputError unless it is one
/// real number, or an array of real numbers (for None, text, complex numbers ...); what a
/// conversion raises comes out as it is. NaN and infinity pass.
double real_number(py::handle answer, const std::string& what);
Array real_array(py::handle answer, const std::string& what);

// What a function was given as the argument `name`. They throw InputError, with the name, unless it
// is that: nothing is dropped of complex and masked numbers.
double number_argument(py::handle value, const std::string& name);
Array array_argument(py::handle value, const std::string& name);
Eigen::VectorXd vector_argument(py::handle value, const std::string& name);
std::int64_t integer_argument(py::handle value, const std::string& name, std::int64_t least,
                              std::int64_t most);
std::string text_argument(py::handle value, const std::string& name);
Setting settings_argument(py::handle value, const std::string& name);  ///< of a dict

/// Rows (x, y) in metres. Throws InputError unless it is an array with two columns of finite
/// numbers of at most 1e9.
std::vector<Eigen::Vector2d> points(py::handle value, const std::string& name);

// What each file adds to the module.
void add_trials(py::module_& module);
void add_studies(py::module_& module);
void add_planners(py::module_& module);
void add_potentials(py::module_& module);
void add_problems(py::module_& module);
void add_catalogue(py::module_& module);
void add_classes(py::module_& module);

}  // namespace shoal::python
