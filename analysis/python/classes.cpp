// Classes of Python as members of families.

#include <map>

#include "python_class.hpp"
#include "shoal/formations/conformance.hpp"
#include "world_view.hpp"

namespace shoal::python {
namespace {

const std::map<std::string, PutClass> families_of_classes{{"behaviour", &put_behaviour},
                                                          {"selection", &put_selection},
                                                          {"guidance", &put_guidance},
                                                          {"solver", &put_solver},
                                                          {"measure", &put_measure}};

void keep_class(const std::string& family, const std::string& kind, const std::string& summary,
                const std::string& version, const py::object& type, const py::list& parameters) {
  const bool solves = family == "solver";
  families_of_classes.at(family)(
      std::make_shared<PythonClass>(kind, version, type, parameters, solves), summary);
}

std::vector<std::string> violations(const std::string& kind, const py::dict& options,
                                    double turn_step_deg, double tolerance_m) {
  const auto behaviour = Registry<formations::Behaviour>::instance().make(kind, to_setting(options),
                                                                          "behaviour." + kind);
  return formations::violations(*behaviour,
                                {.turn_step_deg = turn_step_deg, .tolerance_m = tolerance_m});
}

}  // namespace

void add_classes(py::module_& module) {
  add_neighbourhoods(module);
  add_solver_view(module);
  add_world_view(module);
  module.def("keep_class", &keep_class, py::arg("family"), py::arg("kind"), py::arg("summary"),
             py::arg("version"), py::arg("type"), py::arg("parameters"));
  module.def("violations", &violations, py::arg("kind"), py::arg("options"),
             py::arg("turn_step_deg"), py::arg("tolerance_m"));
}

}  // namespace shoal::python
