#include <chrono>
#include <cmath>

#include "planner_arguments.hpp"
#include "shoal/core/interruption.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/solvers/loss.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"
#include "watch.hpp"

namespace shoal::python {
namespace {

using solvers::Problem;
using solvers::Solution;
using Vector = Eigen::VectorXd;

/// A cost that is a Python function. Derivatives that are not given are central differences: of the
/// gradient where there is one, else of the cost.
class PythonCost final : public solvers::Objective {
 public:
  struct Functions {
    py::object cost, gradient, hessian;  // None where not given
  };

  PythonCost(Functions functions, int dimension)
      : functions_(std::make_shared<Functions>(std::move(functions))), dimension_(dimension) {}

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    const py::gil_scoped_acquire held;
    const Vector place = Eigen::Map<const Vector>(x, dimension_);
    if (gradient) Eigen::Map<Vector>(gradient, dimension_) = slope(place);
    if (hessian) Eigen::Map<Eigen::MatrixXd>(hessian, dimension_, dimension_) = curvature(place);
    return value(place);
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return solvers::copied_into(*this, storage, size);
  }

 private:
  double value(const Vector& x) const { return real_number(functions_->cost(x), "the cost"); }

  Vector slope(const Vector& x) const {
    if (!functions_->gradient.is_none()) {
      const Array entries = real_array(functions_->gradient(x), "the gradient");
      const Vector given = Eigen::Map<const Vector>(entries.data(), entries.size());
      if (given.size() != dimension_) {
        throw InputError("the gradient has " + std::to_string(given.size()) + " entries for " +
                         std::to_string(dimension_) + " unknowns");
      }
      return given;
    }
    Vector g(dimension_);
    for (int i = 0; i < dimension_; ++i) {
      const double h = step(x[i], 1.0 / 3.0);
      g[i] = (value(moved(x, i, h)) - value(moved(x, i, -h))) / (2.0 * h);
    }
    return g;
  }

  Eigen::MatrixXd curvature(const Vector& x) const {
    if (!functions_->hessian.is_none()) {
      const Array entries = real_array(functions_->hessian(x), "the Hessian");
      if (entries.ndim() != 2 || entries.shape(0) != dimension_ || entries.shape(1) != dimension_) {
        throw InputError("the Hessian is no matrix of " + std::to_string(dimension_) + " by " +
                         std::to_string(dimension_));
      }
      // Rows for columns: it is symmetric.
      return Eigen::Map<const Eigen::MatrixXd>(entries.data(), dimension_, dimension_).transpose();
    }
    Eigen::MatrixXd H(dimension_, dimension_);
    const bool exact_slope = !functions_->gradient.is_none();
    for (int i = 0; i < dimension_; ++i) {
      const double h = step(x[i], exact_slope ? 1.0 / 3.0 : 1.0 / 6.0);
      H.col(i) = (slope(moved(x, i, h)) - slope(moved(x, i, -h))) / (2.0 * h);
    }
    return 0.5 * (H + H.transpose());
  }

  static Vector moved(Vector x, int i, double by) {
    x[i] += by;
    return x;
  }
  static double step(double x, double power) {
    return std::pow(std::numeric_limits<double>::epsilon(), power) * std::max(1.0, std::abs(x));
  }

  std::shared_ptr<const Functions> functions_;
  int dimension_;
};

/// A problem, and the owner of what its cost refers to.
struct HeldProblem {
  Problem problem;
  std::shared_ptr<const void> owner;  // a behaviour whose parts the cost uses
};

std::optional<Vector> vector_or_none(const py::object& value, const char* name) {
  return value.is_none() ? std::nullopt : std::optional(vector_argument(value, name));
}

HeldProblem python_problem(const py::object& cost, const py::object& first,
                           const py::object& gradient, const py::object& hessian,
                           const py::object& low, const py::object& high) {
  const Vector start = vector_argument(first, "start");
  const auto lower = vector_or_none(low, "lower"), upper = vector_or_none(high, "upper");
  if (start.size() < 1) throw InputError("the start has no unknowns");
  if (lower.has_value() != upper.has_value()) {
    throw InputError("bounds come in pairs: give lower and upper, or neither");
  }
  if (lower && (lower->size() != start.size() || upper->size() != start.size())) {
    throw InputError("bounds must have as many entries as the start");
  }
  HeldProblem held{
      Problem(start, PythonCost({cost, gradient, hessian}, static_cast<int>(start.size()))), {}};
  if (lower) {
    held.problem.lower = *lower;
    held.problem.upper = *upper;
  }
  return held;
}

/// The smooth problems that a behaviour solves for a vehicle at the origin.
std::vector<HeldProblem> posed(const py::object& behaviour_kind, const py::object& options,
                               const py::object& neighbours, const py::object& given_plan,
                               const py::object& own_slot, const py::object& given_slots,
                               const py::object& given_waypoint) {
  const std::string kind = text_argument(behaviour_kind, "behaviour");
  const std::shared_ptr<const formations::Behaviour> behaviour =
      Registry<formations::Behaviour>::instance().make(kind, settings_argument(options, "options"),
                                                       "behaviour." + kind);
  const formations::Plan& plan = plan_argument(given_plan, "plan");
  const std::vector<int> slots = slots_argument(given_slots, "slots", plan.size());
  const auto waypoint = place_or_none(given_waypoint, "waypoint");
  if (behaviour->needs_waypoint() && !waypoint) {
    throw InputError("behaviour " + kind + " leads to a waypoint; give waypoint = (east, north)");
  }
  const std::vector<Eigen::Vector2d> places = points(neighbours, "neighbours");
  if (!slots.empty() && slots.size() != places.size()) {
    throw InputError("slots must be as many as neighbours, or none");
  }
  std::vector<formations::Neighbour> around;
  for (std::size_t i = 0; i < places.size(); ++i) {
    around.push_back({places[i], 0.0, slots.empty() ? formations::anonymous : slots[i]});
  }
  struct Gathered final : solvers::SolveObserver {
    std::vector<HeldProblem> problems;
    std::shared_ptr<const void> owner;
    void solved(const solvers::Solved& what) override {
      if (const auto* problem = what.problem<Problem>()) problems.push_back({*problem, owner});
    }
  };
  Gathered gathered;
  gathered.owner = behaviour;
  solvers::SolveObserver* const observers[] = {&gathered};
  behaviour->step(
      {.neighbours = around,
       .own_slot = static_cast<int>(integer_argument(own_slot, "own_slot", 0, plan.size() - 1)),
       .waypoint = waypoint.value_or(Eigen::Vector2d::Zero())},
      plan, formations::Solving(nullptr, observers));
  return gathered.problems;
}

Solution solve(const HeldProblem& held, const py::object& solver_kind, const py::object& options) {
  const std::string kind = text_argument(solver_kind, "solver");
  const auto solver = Registry<solvers::Solver>::instance().make(
      kind, settings_argument(options, "options"), "solver." + kind);
  if (const auto why = solver->refuses(held.problem)) throw InputError(kind + " " + *why);
  return solver->solve(held.problem);
}

py::dict registered(const py::object& from, const py::object& to, const py::object& given_weights,
                    const py::object& solver_kind, const py::object& loss_kind,
                    const py::object& options, const py::object& loss_options) {
  const std::string kind = text_argument(solver_kind, "solver");
  const std::string loss = text_argument(loss_kind, "loss");
  const std::optional<Vector> weights = vector_or_none(given_weights, "weights");
  const std::vector<Eigen::Vector2d> sources = points(from, "from_points");
  const std::vector<Eigen::Vector2d> places = points(to, "to_points");
  if (sources.size() != places.size() ||
      (weights && static_cast<std::size_t>(weights->size()) != sources.size())) {
    throw InputError("from_points, to_points and weights must be equally many");
  }
  std::vector<solvers::PointPair> pairs;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    pairs.push_back(
        {sources[i], places[i], weights ? (*weights)[static_cast<Eigen::Index>(i)] : 1.0});
  }
  const auto measure = Registry<solvers::Loss>::instance().make(
      loss, settings_argument(loss_options, "loss_options"), "loss." + loss);
  const solvers::RegistrationProblem problem{pairs, measure.get()};
  const auto solver = Registry<solvers::RegistrationSolver>::instance().make(
      kind, settings_argument(options, "options"), "registration." + kind);
  if (const auto why = solver->refuses(problem)) throw InputError(kind + " " + *why);
  const solvers::RegistrationSolution solution = solver->solve(problem);
  py::dict answer;
  answer["angle_rad"] = solution.T_to_from.angle();
  answer["translation"] = solution.T_to_from.translation;
  answer["cost"] = solution.cost;
  answer["status"] = name_of(solution.status);
  answer["usable"] = solution.usable();
  return answer;
}

py::dict matched(const py::object& seen, const py::object& slots, const py::object& own_weight,
                 const py::object& solver_kind, const py::object& options) {
  const std::string kind = text_argument(solver_kind, "solver");
  const double ownship_weight = number_argument(own_weight, "ownship_weight");
  const std::vector<Eigen::Vector2d> places = points(seen, "points");
  const std::vector<Eigen::Vector2d> plan = points(slots, "slots");
  if (!(ownship_weight >= 0.0 && std::isfinite(ownship_weight))) {
    throw InputError("ownship_weight is " + shortest(ownship_weight) +
                     "; it takes a finite number of at least 0");
  }
  if (places.empty() || places.size() > plan.size()) {
    throw InputError("there are " + std::to_string(places.size()) + " points for " +
                     std::to_string(plan.size()) +
                     " slots; there has to be a point, and a slot for each");
  }
  const auto matcher = Registry<solvers::Matcher>::instance().make(
      kind, settings_argument(options, "options"), "matching." + kind);
  const solvers::MatchingProblem problem{
      .points = places, .slots = plan, .ownship_weight = ownship_weight};
  if (const auto why = matcher->refuses(problem)) throw InputError(kind + " " + *why);
  const solvers::MatchingSolution solution = [&] {
    const Interruption interruption(python_signals());
    const py::gil_scoped_release free;
    return matcher->solve(problem);
  }();
  py::dict answer;
  answer["slots"] = std::vector<int>(solution.slot_of_point.begin(), solution.slot_of_point.end());
  answer["rotation_rad"] = solution.rotation;
  answer["cost"] = solution.cost;
  answer["usable"] = solution.usable();
  return answer;
}

}  // namespace

void add_problems(py::module_& module) {
  py::class_<HeldProblem>(
      module, "Problem",
      "A smooth problem: minimise cost(x) from a start, inside bounds if there are any.\n"
      "cost takes an array; gradient and hessian, where not given, are central "
      "differences.")
      .def(py::init(&python_problem), py::arg("cost"), py::arg("start"), py::kw_only(),
           py::arg("gradient") = py::none(), py::arg("hessian") = py::none(),
           py::arg("lower") = py::none(), py::arg("upper") = py::none())
      .def_property_readonly("start",
                             [](const HeldProblem& held) -> Vector { return held.problem.start; })
      .def(
          "evaluate",
          [](const HeldProblem& held, const py::object& place) {
            const Vector x = vector_argument(place, "x");
            const int n = held.problem.dimension();
            if (x.size() != n) {
              throw InputError("x has " + std::to_string(x.size()) + " entries for " +
                               std::to_string(n) + " unknowns");
            }
            Vector gradient(n);
            Eigen::MatrixXd hessian(n, n);
            const double cost = held.problem.evaluate(x.data(), gradient.data(), hessian.data());
            return py::make_tuple(cost, gradient, hessian);
          },
          py::arg("x"), "Cost, gradient and Hessian.");

  py::class_<Solution>(module, "Solution",
                       "How a solve ended. status is our own check of the point and never the\n"
                       "backend's word; x is NaN until set.")
      .def_property_readonly("x", [](const Solution& s) -> Vector { return s.x; })
      .def_readonly("cost", &Solution::cost)
      .def_property_readonly("status", [](const Solution& s) { return name_of(s.status); })
      .def_property_readonly("usable", &Solution::usable)
      .def_property_readonly("backend_says",
                             [](const Solution& s) { return std::string(s.backend_says); })
      .def_readonly("evaluations", &Solution::evaluations)
      .def_readonly("violation", &Solution::violation)
      .def_readonly("seconds", &Solution::seconds)
      .def("__repr__", [](const Solution& s) {
        return "<shoal.Solution " + std::string(name_of(s.status)) + ", cost " +
               std::string(py::str(py::float_(s.cost))) + ", " + std::to_string(s.evaluations) +
               " evaluations>";
      });

  module.def(
      "solve", &solve, py::arg("problem"), py::arg("solver") = "newton",
      py::arg("options") = py::dict(),
      "Minimises a problem. Raises InputError, with the reason, if the solver refuses it, and\n"
      "what the cost raises.");
  module.def(
      "posed", &posed, py::arg("behaviour"), py::arg("options"), py::arg("neighbours"),
      py::arg("plan"), py::arg("own_slot") = 0, py::arg("slots") = py::tuple(),
      py::arg("waypoint") = py::none(),
      "The smooth problems that a behaviour solves for a vehicle at the origin. neighbours:\n"
      "array (neighbours, 2), metres in its own frame; slots: theirs in the plan; waypoint: in "
      "the\n"
      "same frame, for behaviours that lead to one. Raises InputError.");
  module.def("register", &registered, py::arg("from_points"), py::arg("to_points"),
             py::arg("weights") = py::none(), py::arg("solver") = "procrustes",
             py::arg("loss") = "least_squares", py::arg("options") = py::dict(),
             py::arg("loss_options") = py::dict(),
             "The rigid motion, never a reflection, that lays points best onto their partners.\n"
             "Arrays (points, 2), metres. A dict: angle_rad, translation, cost, status, usable.");
  module.def(
      "match", &matched, py::arg("points"), py::arg("slots"),
      py::arg("ownship_weight") = solvers::MatchingProblem{}.ownship_weight,
      py::arg("solver") = "sampled", py::arg("options") = py::dict(),
      "Which slots points take, and how they are turned onto the plan; the own position first.\n"
      "Arrays (n, 2), metres. A dict: slots, rotation_rad, cost, usable. Ctrl-C ends it. Raises\n"
      "InputError, also if points x rotations x slots are more than 1e9.");
}

}  // namespace shoal::python
