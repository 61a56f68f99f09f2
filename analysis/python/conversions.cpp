#include "conversions.hpp"

#include <optional>
#include <string_view>

#include "shoal/core/nesting.hpp"

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
  const auto refuse = [&](const std::string& given) {
    throw InputError(what + " returned " + given + "; it has to return one real number");
  };
  if (py::hasattr(answer, "ndim") && answer.attr("ndim").cast<int>() > 0) {
    refuse("an array of shape " + std::string(py::str(answer.attr("shape"))));
  }
  if (const auto given = no_real_kind(answer)) refuse(*given);
  const double number = PyFloat_AsDouble(answer.ptr());
  if (!PyErr_Occurred()) return number;
  if (PyLong_Check(answer.ptr()) && PyErr_ExceptionMatches(PyExc_OverflowError)) {
    PyErr_Clear();
    refuse("an integer too large for a real number");
  }
  throw py::error_already_set();
}

Array real_array(py::handle answer, const std::string& what) {
  const auto refuse = [&](const std::string& given) {
    throw InputError(what + " returned " + given + "; it has to return an array of real numbers");
  };
  if (answer.is_none()) refuse("None");
  if (is_masked(answer)) refuse("a masked array");
  const py::array array = py::array::ensure(answer);
  if (!array) refuse("a " + type_of(answer));
  const char kind = array.dtype().kind();
  if (kind == 'c') refuse("complex numbers");
  if (std::string_view("biuf").find(kind) == std::string_view::npos) {
    refuse("an array of " + std::string(py::str(array.dtype())));
  }
  return array.cast<Array>();
}

std::vector<Eigen::Vector2d> points(const Array& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 2) {
    throw InputError(std::string(what) + " must be an array with two columns, east and north");
  }
  std::vector<Eigen::Vector2d> all;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    all.emplace_back(array.at(i, 0), array.at(i, 1));
    if (!all.back().allFinite()) {
      throw InputError(std::string(what) + ": row " + std::to_string(i) + " is not finite");
    }
  }
  return all;
}

}  // namespace shoal::python
