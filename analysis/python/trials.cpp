#include <limits>
#include <optional>

#include "conversions.hpp"
#include "shoal/analysis/measures/formation_quality.hpp"
#include "shoal/analysis/report/run_report.hpp"
#include "shoal/analysis/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"

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
  overlay(root, to_setting(changes));
  return scenarios::read_scenario(root);
}

/// Runs without the interpreter: Python's other threads go on. Returns the text of summary.json.
std::string run(const py::object& scenario, const py::dict& changes, const std::string& name,
                const std::string& folder, int threads, bool record, bool report) {
  if (threads < 1) throw InputError("threads is " + std::to_string(threads) + "; give at least 1");
  const scenarios::Scenario read_in = read(scenario, changes);
  const py::gil_scoped_release free;
  const analysis::Trial trial =
      analysis::run_trial(read_in, {.threads = threads, .record = record, .behaviour_hook = {}});
  analysis::write_trial(trial, name, folder);
  if (report) analysis::write_run_report(folder);
  return analysis::summary_json(trial, name);
}

double quality(const Array& positions, const formations::Plan& plan, const std::string& alignment,
               double delta_theta_deg) {
  using Alignment = scenarios::QualityOptions::Alignment;
  if (alignment != "centroid" && alignment != "nearest_point") {
    throw InputError("alignment is \"" + alignment + "\"; it is centroid or nearest_point");
  }
  if (!(delta_theta_deg > 0.0 && delta_theta_deg <= 360.0)) {
    throw InputError("delta_theta_deg must be above 0 and at most 360");
  }
  const std::vector<Eigen::Vector2d> places = points(positions, "positions");
  if (places.empty()) throw InputError("there are no positions");
  if (places.size() > static_cast<std::size_t>(plan.size())) {
    throw InputError("there are " + std::to_string(places.size()) + " positions for " +
                     std::to_string(plan.size()) + " slots; pad the plan");
  }
  return analysis::FormationQuality(
             plan, alignment == "centroid" ? Alignment::centroid : Alignment::nearest_point,
             delta_theta_deg)
      .of(places);
}

/// The current of a scenario at places, one after the other: none where it knows none.
py::tuple current(const py::object& scenario, double time_s, const Array& x, const Array& y) {
  const auto sea = read(scenario, {}).current.make();
  if (x.size() != y.size()) throw InputError("x and y must be equally many");
  const std::vector<py::ssize_t> shape(x.shape(), x.shape() + x.ndim());
  Array u(shape), v(shape);
  for (py::ssize_t i = 0; i < x.size(); ++i) {
    double velocity[2];
    const double place[] = {x.data()[i], y.data()[i]};
    try {
      sea->sample(time_s, {place, 1}, {place + 1, 1}, {velocity, 1}, {velocity + 1, 1});
    } catch (const InputError&) {
      velocity[0] = velocity[1] = std::numeric_limits<double>::quiet_NaN();
    }
    u.mutable_data()[i] = velocity[0];
    v.mutable_data()[i] = velocity[1];
  }
  return py::make_tuple(u, v);
}

}  // namespace

void add_trials(py::module_& module) {
  module.def("run", &run, py::arg("scenario"), py::arg("set"), py::arg("name"), py::arg("folder"),
             py::arg("threads"), py::arg("record"), py::arg("report"));
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
      py::arg("alignment") = "centroid", py::arg("delta_theta_deg") = 10.0,
      "Mean distance (m) between vehicles and the slots of a plan, assigned and laid onto them as\n"
      "well as a search over rotations finds: Rypkema 2015, sec. 4.3.\n\n"
      "positions: array (vehicles, 2), metres east and north. The plan needs as many slots, or "
      "more\n"
      "(`Plan.padded`, as the measure `quality` of a run). Raises InputError.");
}

}  // namespace shoal::python
