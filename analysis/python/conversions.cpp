#include "conversions.hpp"

namespace shoal::python {
namespace {

std::string type_of(py::handle value) {
  return py::str(py::type::of(value).attr("__name__"));
}

Setting plain(auto value) {
  return Setting{std::move(value), {}};
}

}  // namespace

Setting to_setting(py::handle value) {
  if (py::hasattr(value, "_setting_")) return to_setting(value.attr("_setting_")());
  if (py::isinstance<py::bool_>(value)) return plain(value.cast<bool>());
  if (py::isinstance<py::str>(value)) return plain(value.cast<std::string>());
  if (py::isinstance<py::dict>(value)) {
    Setting table;
    for (const auto& [key, entry] : value.cast<py::dict>()) {
      if (!py::isinstance<py::str>(key)) {
        throw InputError("a key is a " + type_of(key) + "; keys are texts, as \"trial.seed\"");
      }
      Setting branch;
      assign(branch, key.cast<std::string>(), to_setting(entry));
      overlay(table, std::move(branch));
    }
    return table;
  }
  if (py::hasattr(value, "__fspath__")) {
    return plain(value.attr("__fspath__")().cast<std::string>());
  }
  // numpy's numbers are neither int nor float, and say of themselves what they are.
  if (py::hasattr(value, "__index__")) {
    return plain(py::int_(value.attr("__index__")()).cast<std::int64_t>());
  }
  if (py::isinstance<py::float_>(value) ||
      (py::hasattr(value, "__float__") && !py::hasattr(value, "__len__"))) {
    return plain(value.cast<double>());
  }
  if (py::hasattr(value, "__iter__")) {
    Setting::List list;
    for (const py::handle entry : value) list.push_back(to_setting(entry));
    return plain(std::move(list));
  }
  throw InputError("a value is a " + type_of(value) + ", which no option takes");
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
