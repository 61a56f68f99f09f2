#include "planner_arguments.hpp"

namespace shoal::python {
namespace {

using formations::OwnState;
using formations::Ping;
using formations::Plan;

[[noreturn]] void refuse_argument(py::handle value, const std::string& name, const char* taken) {
  const py::str shown = py::module_::import("reprlib").attr("repr")(value);
  throw InputError(name + " is " + std::string(shown) + "; it takes " + taken);
}

template <class T>
const T& instance_argument(py::handle value, const std::string& name, const char* taken) {
  if (!py::isinstance<T>(value)) refuse_argument(value, name, taken);
  return value.cast<const T&>();
}

py::sequence sequence_argument(py::handle value, const std::string& name, const char* taken) {
  if (py::isinstance<py::str>(value) || !py::isinstance<py::sequence>(value)) {
    refuse_argument(value, name, taken);
  }
  return value.cast<py::sequence>();
}

}  // namespace

Eigen::Vector2d place_argument(py::handle value, const std::string& name) {
  const Eigen::VectorXd numbers = vector_argument(value, name);
  if (numbers.size() != 2) {
    throw InputError(name + " has " + std::to_string(numbers.size()) +
                     " numbers; it takes two, east and north");
  }
  return numbers;
}

std::optional<Eigen::Vector2d> place_or_none(py::handle value, const std::string& name) {
  if (value.is_none()) return std::nullopt;
  return place_argument(value, name);
}

const Plan& plan_argument(py::handle value, const std::string& name) {
  return instance_argument<Plan>(value, name, "a Plan");
}

const Ping& ping_argument(py::handle value, const std::string& name) {
  return instance_argument<Ping>(value, name, "a Ping");
}

bool is_state(py::handle value) {
  return py::isinstance<OwnState>(value);
}

std::optional<OwnState> state_or_none(py::handle value, const std::string& name) {
  if (value.is_none()) return std::nullopt;
  return instance_argument<OwnState>(value, name, "an OwnState, or None");
}

OwnState state_or_place(py::handle value, const std::string& name) {
  if (is_state(value)) return value.cast<OwnState>();
  if (value.is_none()) refuse_argument(value, name, "an OwnState, or a position");
  return {.position = place_argument(value, name)};
}

std::optional<std::string> text_or_none(py::handle value, const std::string& name) {
  if (value.is_none()) return std::nullopt;
  return text_argument(value, name);
}

std::vector<std::string> texts_argument(py::handle value, const std::string& name) {
  std::vector<std::string> texts;
  for (const py::handle each : sequence_argument(value, name, "a list of texts")) {
    texts.push_back(text_argument(each, "an entry of " + name));
  }
  return texts;
}

std::vector<int> slots_argument(py::handle value, const std::string& name, int plan_size) {
  std::vector<int> slots;
  for (const py::handle each : sequence_argument(value, name, "a sequence of integers")) {
    const std::string place = name + "[" + std::to_string(slots.size()) + "]";
    slots.push_back(static_cast<int>(integer_argument(each, place, -1, plan_size - 1)));
  }
  return slots;
}

std::vector<Setting> list_of_settings(py::handle value, const std::string& name) {
  std::vector<Setting> list;
  for (const py::handle each : sequence_argument(value, name, "a list of dicts")) {
    list.push_back(settings_argument(each, "an entry of " + name));
  }
  return list;
}

}  // namespace shoal::python
