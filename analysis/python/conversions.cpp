#include "conversions.hpp"

#include <optional>
#include <string_view>

#include "shoal/core/nesting.hpp"
#include "shoal/core/text.hpp"

namespace shoal::python {
namespace {

std::string type_of(py::handle value) {
  return py::str(py::type::of(value).attr("__name__"));
}

std::string shown(py::handle value) {
  return py::str(py::module_::import("reprlib").attr("repr")(value));
}

/// Without what no UTF-8 has: halves of surrogate pairs.
std::string text_of(py::handle value) {
  Py_ssize_t size = 0;
  const char* bytes = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (bytes) return {bytes, static_cast<std::size_t>(size)};
  if (!PyErr_ExceptionMatches(PyExc_UnicodeError)) throw py::error_already_set();
  PyErr_Clear();
  throw InputError("the text " + shown(value) + " is not valid Unicode");
}

bool is_masked(py::handle value) {
  return py::isinstance(value, py::module_::import("numpy").attr("ma").attr("MaskedArray"));
}

Setting plain(auto value) {
  return Setting{std::move(value), {}};
}

/// What it is instead, if it is no real number.
std::optional<std::string> no_real_kind(py::handle value) {
  if (value.is_none()) return "None";
  if (is_masked(value)) return "a masked array";
  if (py::isinstance<py::str>(value)) return "text";
  // numpy's complex numbers would convert, with a warning only.
  const bool complex_scalar =
      py::hasattr(value, "dtype") && py::str(value.attr("dtype").attr("kind")).equal(py::str("c"));
  if (PyComplex_Check(value.ptr()) || complex_scalar) return "a complex number";
  if (py::hasattr(value, "__float__") || py::hasattr(value, "__index__")) return std::nullopt;
  return "a " + type_of(value);
}

Setting setting_within(py::handle value, std::size_t depth);

Setting table_of(const py::dict& entries, std::size_t depth) {
  Setting table;
  for (const auto& [key, entry] : entries) {
    if (!py::isinstance<py::str>(key)) {
      throw InputError("a key is a " + type_of(key) + "; keys are texts, as \"trial.seed\"");
    }
    Setting branch;
    assign(branch, text_of(key), setting_within(entry, depth));
    overlay(table, std::move(branch));
  }
  return table;
}

/// numpy's numbers are neither int nor float, and say of themselves what they are.
std::int64_t integer_of(py::handle value) {
  const auto integer = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!integer) throw py::error_already_set();
  int beyond = 0;
  const long long number = PyLong_AsLongLongAndOverflow(integer.ptr(), &beyond);
  if (beyond != 0) throw InputError("an integer has more than 64 bits, which no option takes");
  return number;
}

Setting setting_within(py::handle value, std::size_t depth) {
  if (depth == 0) {
    throw InputError("a value is nested more than " + std::to_string(deepest_nesting) +
                     " deep, or contains itself");
  }
  const std::size_t below = depth - 1;
  if (py::hasattr(value, "_setting_")) return setting_within(value.attr("_setting_")(), below);
  if (py::isinstance<py::bool_>(value)) return plain(value.cast<bool>());
  if (py::isinstance<py::str>(value)) return plain(text_of(value));
  if (py::isinstance<py::dict>(value)) return table_of(value.cast<py::dict>(), below);
  if (py::hasattr(value, "__fspath__")) {
    const py::object path = value.attr("__fspath__")();
    if (!py::isinstance<py::str>(path)) {
      throw InputError("the path " + shown(path) + " is a " + type_of(path) + "; give it as text");
    }
    return plain(text_of(path));
  }
  if (py::hasattr(value, "__index__")) return plain(integer_of(value));
  if (py::isinstance<py::float_>(value) ||
      (py::hasattr(value, "__float__") && !py::hasattr(value, "__len__"))) {
    return plain(value.cast<double>());
  }
  if (py::hasattr(value, "__iter__")) {
    Setting::List list;
    for (const py::handle entry : value) list.push_back(setting_within(entry, below));
    return plain(std::move(list));
  }
  throw InputError("a value is a " + type_of(value) + ", which no option takes");
}

/// The words around what a value is instead of a number, in a message.
struct Refusal {
  std::string before, after;

  [[noreturn]] void of(const std::string& given) const { throw InputError(before + given + after); }
};

double number_of(py::handle value, const Refusal& refuse) {
  if (py::hasattr(value, "ndim") && value.attr("ndim").cast<int>() > 0) {
    refuse.of("an array of shape " + std::string(py::str(value.attr("shape"))));
  }
  if (const auto given = no_real_kind(value)) refuse.of(*given);
  const double number = PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return number;
  if (PyLong_Check(value.ptr()) && PyErr_ExceptionMatches(PyExc_OverflowError)) {
    PyErr_Clear();
    refuse.of("an integer too large for a real number");
  }
  throw py::error_already_set();
}

Array array_of(py::handle value, const Refusal& refuse) {
  if (value.is_none()) refuse.of("None");
  if (is_masked(value)) refuse.of("a masked array");
  const py::array array = py::array::ensure(value);
  if (!array) refuse.of("a " + type_of(value));
  const char kind = array.dtype().kind();
  if (kind == 'c') refuse.of("an array of complex numbers");
  if (std::string_view("biuf").find(kind) == std::string_view::npos) {
    refuse.of("an array of " + std::string(py::str(array.dtype())));
  }
  return array.cast<Array>();
}

}  // namespace

Setting to_setting(py::handle value) {
  return setting_within(value, deepest_nesting);
}

py::object to_python(const Setting& setting) {
  struct Visitor {
    py::object operator()(bool value) const { return py::bool_(value); }
    py::object operator()(std::int64_t value) const { return py::int_(value); }
    py::object operator()(double value) const { return py::float_(value); }
    py::object operator()(const std::string& value) const { return py::str(value); }
    py::object operator()(const Setting::List& value) const {
      py::list list;
      for (const Setting& entry : value) list.append(to_python(entry));
      return list;
    }
    py::object operator()(const Setting::Table& value) const {
      py::dict table;
      for (const auto& [name, entry] : value) table[py::str(name)] = to_python(entry);
      return table;
    }
  };
  return std::visit(Visitor{}, setting.value);
}

double real_number(py::handle answer, const std::string& what) {
  if (PyFloat_Check(answer.ptr())) return PyFloat_AS_DOUBLE(answer.ptr());
  return number_of(answer, {what + " returned ", "; it has to return one real number"});
}

Array real_array(py::handle answer, const std::string& what) {
  return array_of(answer, {what + " returned ", "; it has to return an array of real numbers"});
}

double number_argument(py::handle value, const std::string& name) {
  return number_of(value, {name + " is ", "; it takes one real number"});
}

Array array_argument(py::handle value, const std::string& name) {
  return array_of(value, {name + " is ", "; it takes an array of real numbers"});
}

Eigen::VectorXd vector_argument(py::handle value, const std::string& name) {
  const Array array = array_argument(value, name);
  if (array.ndim() != 1) {
    throw InputError(name + " has " + std::to_string(array.ndim()) +
                     " dimensions; it takes one row of numbers");
  }
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

std::int64_t integer_argument(py::handle value, const std::string& name, std::int64_t least,
                              std::int64_t most) {
  const auto refuse = [&](const std::string& taken) {
    throw InputError(name + " is " + shown(value) + "; it takes " + taken);
  };
  const bool truth = PyBool_Check(value.ptr()) != 0;
  const auto integer =
      py::reinterpret_steal<py::object>(truth ? nullptr : PyNumber_Index(value.ptr()));
  if (!integer) {
    if (PyErr_Occurred() && !PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
    PyErr_Clear();
    refuse("an integer");
  }
  int beyond = 0;
  const long long number = PyLong_AsLongLongAndOverflow(integer.ptr(), &beyond);
  if (beyond != 0 || number < least || number > most) {
    refuse("from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return number;
}

std::string text_argument(py::handle value, const std::string& name) {
  if (!py::isinstance<py::str>(value)) {
    throw InputError(name + " is " + shown(value) + "; it takes text");
  }
  return text_of(value);
}

Setting settings_argument(py::handle value, const std::string& name) {
  if (!py::isinstance<py::dict>(value)) {
    throw InputError(name + " is " + shown(value) + "; it takes a dict");
  }
  return to_setting(value);
}

std::vector<Eigen::Vector2d> points(py::handle value, const std::string& name) {
  constexpr double farthest_m = 1e9;
  const Array array = array_argument(value, name);
  if (array.ndim() != 2 || array.shape(1) != 2) {
    throw InputError(name + " must be an array with two columns, east and north");
  }
  std::vector<Eigen::Vector2d> all;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const Eigen::Vector2d& place = all.emplace_back(array.at(i, 0), array.at(i, 1));
    if (!place.allFinite()) {
      throw InputError(name + ": row " + std::to_string(i) + " is not finite; give metres");
    }
    if (place.cwiseAbs().maxCoeff() > farthest_m) {
      throw InputError(name + ": row " + std::to_string(i) + " is too large; give at most " +
                       shortest(farthest_m) + " m");
    }
  }
  return all;
}

}  // namespace shoal::python
