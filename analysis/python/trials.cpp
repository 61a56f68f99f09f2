#include <optional>

#include "conversions.hpp"
#include "python_class.hpp"
#include "shoal/analysis/experiments/measures/formation_quality.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/analysis/reporting/known_current.hpp"
#include "shoal/analysis/reporting/run_report.hpp"
#include "shoal/core/interruption.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/netcdf_guard.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "watch.hpp"

namespace shoal::python {
namespace {

/// A scenario by name, by path, or as a dict, with changes by dotted keys.
scenarios::Scenario read(py::object scenario, const py::dict& changes) {
  Setting root;
  if (py::isinstance<py::dict>(scenario)) {
    root = to_setting(scenario);
  } else {
    root = scenarios::read_toml(scenarios::find_scenario(py::str(scenario)));
  }
  Setting given = to_setting(changes);
  scenarios::require_no_scenario_left_out(root, given);
  overlay(root, std::move(given));
  return scenarios::read_scenario(root);
}

/// Runs without the interpreter: Python's other threads go on. Returns the text of summary.json.
std::string run(const py::object& scenario, const py::dict& changes, const std::string& name,
                const std::string& folder, int threads, bool record, bool report,
                py::object progress) {
  const scenarios::Scenario read_in = read(scenario, changes);
  const std::unique_ptr<scenarios::Observer> watching = watch(read_in, std::move(progress));
  const NoNewMembers while_it_runs;
  const py::gil_scoped_release free;
  const Interruption interruption(python_signals());  // between two looks of the watch
  const analysis::Trial trial = analysis::run_trial(
      read_in, {.threads = threads, .record = record, .observers = {watching.get()}});
  analysis::write_trial(trial, name, folder);
  if (report) analysis::write_run_report(folder);
  return analysis::summary_json(trial, name);
}

double quality(const py::object& positions, const formations::Plan& plan, const py::kwargs& given) {
  scenarios::QualityOptions options;
  shoal::read(options, to_setting(given), "quality");
  const std::vector<Eigen::Vector2d> places = points(positions, "positions");
  if (places.empty()) throw InputError("there are no positions");
  if (places.size() > static_cast<std::size_t>(plan.size())) {
    throw InputError("there are " + std::to_string(places.size()) + " positions for " +
                     std::to_string(plan.size()) + " slots; pad the plan");
  }
  const Interruption interruption(python_signals());
  return analysis::FormationQuality(plan, options).of(places).quality_m;
}

/// The current of a scenario at places, one after the other: none where it knows none.
py::tuple current(const py::object& scenario, const py::object& time, const py::object& east,
                  const py::object& north) {
  const double time_s = number_argument(time, "time_s");
  const Array x = array_argument(east, "x"), y = array_argument(north, "y");
  const auto sea = read(scenario, {}).current.make();
  if (x.size() != y.size()) throw InputError("x and y must be equally many");
  const std::vector<py::ssize_t> shape(x.shape(), x.shape() + x.ndim());
  const auto count = static_cast<std::size_t>(x.size());
  Array u(shape), v(shape);
  analysis::sample_known(*sea, time_s, {x.data(), count}, {y.data(), count},
                         {u.mutable_data(), count}, {v.mutable_data(), count});
  return py::make_tuple(u, v);
}

/// A context: other packages of the same process use netCDF, too.
class NetcdfLock {
 public:
  void enter() {
    const py::gil_scoped_release free;
    guard_.emplace();
  }
  void exit(const py::args&) { guard_.reset(); }

 private:
  std::optional<scenarios::NetcdfGuard> guard_;
};

}  // namespace

void add_trials(py::module_& module) {
  py::class_<NetcdfLock>(module, "NetcdfLock")
      .def(py::init<>())
      .def("__enter__", &NetcdfLock::enter)
      .def("__exit__", &NetcdfLock::exit);
  module.attr("most_threads") = analysis::most_threads;
  module.def("run", &run, py::arg("scenario"), py::arg("set"), py::arg("name"), py::arg("folder"),
             py::arg("threads"), py::arg("record"), py::arg("report"), py::arg("progress"));
  module.def(
      "scenario",
      [](const py::object& scenario, const py::dict& changes) {
        return to_python(scenarios::resolved_scenario(read(scenario, changes)));
      },
      py::arg("scenario"), py::arg("set"));
  module.def("current", &current, py::arg("scenario"), py::arg("time_s"), py::arg("x"),
             py::arg("y"));
  module.def(
      "formation_quality", &quality, py::arg("positions"), py::arg("plan"),
      "Mean distance (m) between vehicles and the slots of a plan that is laid onto them, the "
      "least\n"
      "of all rigid motions and assignments: Rypkema 2015, sec. 4.3.\n\n"
      "positions: array (vehicles, 2), metres east and north. The plan needs as many slots, or "
      "more\n"
      "(`Plan.padded`, as the measure `quality` of a run). Options: those of "
      "a\n"
      "scenario's `quality` (alignment, tolerance_m, budget, delta_theta_deg). Raises "
      "InputError.");
}

}  // namespace shoal::python
