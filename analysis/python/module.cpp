#include "conversions.hpp"
#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/plugins.hpp"
#include "shoal/core/error.hpp"
#include "shoal/solvers/solver.hpp"

PYBIND11_MODULE(_shoal, module) {
  namespace py = pybind11;
  using namespace shoal;
  module.doc() = "What the package shoal is made of; import shoal instead.";
  module.attr("version") = analysis::build_info().version;

  // The same text as the program prints.
  static py::exception<InputError> input_error(module, "InputError", PyExc_ValueError);
  input_error.attr("__doc__") = "Input cannot be used: where, what is wrong, and what to do.";
  static py::exception<SystemError> system_error(module, "SystemError", PyExc_OSError);
  system_error.attr("__doc__") = "The surroundings failed: a full disk, an unwritable folder.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      input_error(error.what());
    } catch (const SystemError& error) {
      system_error(error.what());
    }
  });
  solvers::silence_backends();

  analysis::load_plugins_of_environment();
  module.def("program", [] { return analysis::build_info().program; });
  module.def(
      "load_plugin", [](const std::string& file) { analysis::load_plugin(file); }, py::arg("file"));

  python::add_catalogue(module);
  python::add_trials(module);
  python::add_studies(module);
  python::add_planners(module);
  python::add_potentials(module);
  python::add_problems(module);
  python::add_classes(module);
}
