#include <limits>

#include "../python_class.hpp"
#include "shoal/solvers/smooth/attempt.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::python {
namespace {

using solvers::Attempt;
using solvers::Problem;
using solvers::Solution;
using Vector = Eigen::VectorXd;

/// Raised into the solver when it has to come to an end.
py::object& stop_exception() {
  static auto* const stop = new py::object;  // the interpreter may be gone before
  return *stop;
}

/// A problem while a class of Python works on it.
class SolverView {
 public:
  explicit SolverView(Attempt& attempt) : attempt_(&attempt) {}
  void close() { attempt_ = nullptr; }

  Vector start() const { return open().start(); }
  std::optional<Vector> lower() const {
    return open().bounded() ? std::optional<Vector>(open().lower()) : std::nullopt;
  }
  std::optional<Vector> upper() const {
    return open().bounded() ? std::optional<Vector>(open().upper()) : std::nullopt;
  }

  double cost(const py::object& place) const {
    double value = 0.0;
    return evaluated(place, value, nullptr, nullptr) ? value : infinite;
  }

  py::tuple cost_and_gradient(const py::object& place) const {
    double value = 0.0;
    Vector gradient(open().unknowns());
    if (!evaluated(place, value, gradient.data(), nullptr))
      gradient.setConstant(unknown), value = infinite;
    return py::make_tuple(value, gradient);
  }

  py::tuple derivatives(const py::object& place) const {
    double value = 0.0;
    Vector gradient(open().unknowns());
    Eigen::MatrixXd hessian(open().unknowns(), open().unknowns());
    if (!evaluated(place, value, gradient.data(), hessian.data())) {
      value = infinite;
      gradient.setConstant(unknown);
      hessian.setConstant(unknown);
    }
    return py::make_tuple(value, gradient, hessian);
  }

  py::tuple constraints(const py::object& place) const {
    return constrained(place, 0, open().constraints());
  }
  py::tuple equalities(const py::object& place) const {
    return constrained(place, open().constraints(), open().equalities());
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Attempt& open() const {
    if (!attempt_) throw InputError("the problem is only there while solve() runs");
    return *attempt_;
  }

  Vector point(const py::object& place) const {
    const Vector x = vector_argument(place, "x");
    if (x.size() == open().unknowns()) return x;
    throw InputError("x has " + std::to_string(x.size()) + " entries for " +
                     std::to_string(open().unknowns()) + " unknowns");
  }

  /// False where the cost is not finite.
  bool evaluated(const py::object& place, double& value, double* gradient, double* hessian) const {
    const Vector x = point(place);
    const Attempt::Outcome outcome = open().evaluate(x.data(), value, gradient, hessian);
    return finite(outcome);
  }

  py::tuple constrained(const py::object& place, int first, int count) const {
    const Vector x = point(place);
    Vector values(count);
    Eigen::MatrixXd jacobian(count, x.size());
    Vector row(x.size());
    for (int k = 0; k < count; ++k) {
      if (!finite(open().constrain(first + k, x.data(), values[k], row.data()))) {
        values[k] = unknown;
        row.setConstant(unknown);
      }
      jacobian.row(k) = row;
    }
    return py::make_tuple(values, jacobian);
  }

  static bool finite(Attempt::Outcome outcome) {
    if (outcome == Attempt::Outcome::stop) {
      PyErr_SetNone(stop_exception().ptr());
      throw py::error_already_set();
    }
    return outcome == Attempt::Outcome::fine;
  }

  Attempt* attempt_;
};

/// A class with a method solve(problem), which returns a point.
class PythonSolver final : public solvers::Solver {
 public:
  PythonSolver(std::shared_ptr<const Held> object, std::string name, const PythonOptions& options)
      : object_(std::move(object)), name_(std::move(name)), limits_(solvers::Limits::of(options)) {
    const py::gil_scoped_acquire held;
    if (!object_->has("solve")) {
      throw InputError("the class " + name_ + " has no method solve(problem)");
    }
    takes_bounds_ = object_->flag("takes_bounds");
    takes_constraints_ = object_->flag("takes_constraints");
  }

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return solvers::refused(problem);
    Attempt attempt(problem, limits_);
    if (!attempt.open()) return attempt.finish(0, "");
    {
      const py::gil_scoped_acquire held;
      const auto view = std::make_shared<SolverView>(attempt);
      struct Close {
        SolverView& view;
        ~Close() { view.close(); }
      } const at_the_end{*view};
      try_place(attempt, object_->attr("solve"), view);
    }
    return attempt.finish(0, "a class of Python");
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.lower && !takes_bounds_) return "takes no bounds";
    if (problem.constrained() && !takes_constraints_) return "takes no constraints";
    return std::nullopt;
  }

 private:
  void try_place(Attempt& attempt, const py::object& method,
                 const std::shared_ptr<SolverView>& view) const {
    py::object answer;
    try {
      answer = method(view);
    } catch (py::error_already_set& error) {
      if (!error.matches(stop_exception())) throw;
      return;
    }
    const Array place = real_array(answer, name_ + ".solve()");
    if (place.ndim() != 1 || place.size() != attempt.unknowns()) {
      throw InputError(name_ + ".solve() has to return a point of " +
                       std::to_string(attempt.unknowns()) + " unknowns");
    }
    double cost = 0.0;
    attempt.evaluate(place.data(), cost);
  }

  std::shared_ptr<const Held> object_;
  std::string name_;
  solvers::Limits limits_;
  bool takes_bounds_ = false, takes_constraints_ = false;
};

}  // namespace

void put_solver(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  put_class<solvers::Solver>(
      type, summary, [](const PythonClass& from, const PythonOptions& options) {
        return std::make_unique<PythonSolver>(from.make(options), from.name(), options);
      });
}

void add_solver_view(py::module_& module) {
  stop_exception() = py::exception<std::runtime_error>(module, "StopSolving");
  stop_exception().attr("__doc__") =
      "The budget of a solve is spent, or its cost raised something: let it pass.";
  py::class_<SolverView, std::shared_ptr<SolverView>>(
      module, "SolverProblem",
      "A problem while a solver of one's own works on it, in the unknowns that are free. Every\n"
      "cost counts as an evaluation; StopSolving is raised when there may be no more.")
      .def_property_readonly("start", &SolverView::start)
      .def_property_readonly("lower", &SolverView::lower, "None where there are no bounds.")
      .def_property_readonly("upper", &SolverView::upper, "None where there are no bounds.")
      .def("cost", &SolverView::cost, py::arg("x"), "Infinity where it is not finite.")
      .def("cost_and_gradient", &SolverView::cost_and_gradient, py::arg("x"))
      .def("derivatives", &SolverView::derivatives, py::arg("x"), "Cost, gradient and Hessian.")
      .def("constraints", &SolverView::constraints, py::arg("x"),
           "Values, which are to be at least zero, and their Jacobian.")
      .def("equalities", &SolverView::equalities, py::arg("x"),
           "Values, which are to be zero, and their Jacobian.");
}

}  // namespace shoal::python
