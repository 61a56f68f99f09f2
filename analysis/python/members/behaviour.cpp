#include <cmath>

#include "../neighbourhoods.hpp"
#include "../python_class.hpp"
#include "shoal/formations/behaviour.hpp"

namespace shoal::python {
namespace {

using formations::Behaviour;
using formations::Neighbourhood;
using formations::Plan;
using formations::Solving;
using formations::Target;

/// A class with a method target(seen), or targets(seen) for all that plan at an instant.
class PythonBehaviour final : public Behaviour {
 public:
  PythonBehaviour(std::shared_ptr<const Held> object, std::string name)
      : object_(std::move(object)), name_(std::move(name)) {
    const py::gil_scoped_acquire held;
    together_ = object_->has("targets");
    if (!together_ && !object_->has("target")) {
      throw InputError("the class " + name_ + " has no method target(seen) or targets(seen)");
    }
    needs_ids_ = object_->flag("needs_ids");
    needs_waypoint_ = object_->flag("needs_waypoint");
    gives_forces_ = object_->flag("gives_forces");
    needs_clock_ = object_->flag("needs_clock");
  }

  bool needs_ids() const override { return needs_ids_; }
  bool needs_waypoint() const override { return needs_waypoint_; }
  bool gives_forces() const override { return gives_forces_; }
  bool needs_clock() const override { return needs_clock_; }
  bool plans_together() const override { return together_; }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    if (together_) {
      Target target;
      step_together({&seen, 1}, plan, {&solving, 1}, {&target, 1});
      return target;
    }
    const py::gil_scoped_acquire held;
    const py::object answer = object_->attr("target")(one_neighbourhood(seen, plan));
    if (answer.is_none()) return hold(seen);
    const Array place = real_array(answer, name_ + ".target()");
    if (place.ndim() != 1 || place.size() != 2)
      refuse("target", "one place (east, north), or None");
    return target_at({place.at(0), place.at(1)}, "target");
  }

  void step_together(std::span<const Neighbourhood> seen, const Plan& plan,
                     std::span<const Solving> solving, std::span<Target> targets) const override {
    if (!together_) return Behaviour::step_together(seen, plan, solving, targets);
    const py::gil_scoped_acquire held;
    const Array places =
        real_array(object_->attr("targets")(many_neighbourhoods(seen, plan)), name_ + ".targets()");
    if (places.ndim() != 2 || places.shape(0) != static_cast<py::ssize_t>(seen.size()) ||
        places.shape(1) != 2) {
      refuse("targets", "a row (east, north) for each of the vehicles, of NaN to hold");
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto row = static_cast<py::ssize_t>(i);
      const Eigen::Vector2d place(places.at(row, 0), places.at(row, 1));
      const bool holds = std::isnan(place.x()) && std::isnan(place.y());
      targets[i] = holds ? hold(seen[i]) : target_at(place, "targets");
    }
  }

 private:
  static Target hold(const Neighbourhood& seen) {
    return Target::hold(seen.neighbours.empty() ? formations::Reason::no_neighbour
                                                : formations::Reason::degenerate);
  }

  Target target_at(const Eigen::Vector2d& place, const char* method) const {
    if (!place.allFinite()) refuse(method, "finite numbers");
    return gives_forces_ ? Target::push(place, 0.0) : Target::at(place, 0.0);
  }

  [[noreturn]] void refuse(const char* method, const char* wanted) const {
    throw InputError(name_ + "." + method + "() has to return " + wanted);
  }

  std::shared_ptr<const Held> object_;
  std::string name_;
  bool together_, needs_ids_, needs_waypoint_, gives_forces_, needs_clock_;
};

}  // namespace

void put_behaviour(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  put_class<Behaviour>(type, summary, [](const PythonClass& from, const PythonOptions& options) {
    return std::make_unique<PythonBehaviour>(from.make(options), from.name());
  });
}

}  // namespace shoal::python
