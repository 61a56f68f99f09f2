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

/// What an object remembers of one vehicle; a copy is a deep one.
class PythonMemory final : public Memory {
 public:
  explicit PythonMemory(py::object content) : content_(std::move(content)) {}

  std::unique_ptr<Memory> clone() const override {
    const py::gil_scoped_acquire held;
    return std::make_unique<PythonMemory>(
        py::module_::import("copy").attr("deepcopy")(content_.object()));
  }
  const py::object& content() const { return content_.object(); }

 private:
  Held content_;
};

/// A class with a method target(seen), or targets(seen) for all that plan at an instant; with
/// new_memory(), they are also given what it returned for the vehicle, or a list of that.
class PythonBehaviour final : public Behaviour {
 public:
  PythonBehaviour(std::shared_ptr<const Held> object, std::string name)
      : object_(std::move(object)), name_(std::move(name)) {
    const py::gil_scoped_acquire held;
    together_ = object_->has("targets");
    if (!together_ && !object_->has("target")) {
      throw InputError("the class " + name_ + " has no method target(seen) or targets(seen)");
    }
    remembers_ = object_->has("new_memory");
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

  std::unique_ptr<Memory> new_memory() const override {
    if (!remembers_) return nullptr;
    const py::gil_scoped_acquire held;
    return std::make_unique<PythonMemory>(object_->attr("new_memory")());
  }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    if (together_) {
      Target target;
      step_together({&seen, 1}, plan, {&solving, 1}, {&target, 1});
      return target;
    }
    const py::gil_scoped_acquire held;
    const py::object method = object_->attr("target"), given = one_neighbourhood(seen, plan);
    const py::object answer = remembers_ ? method(given, memory_of(solving)) : method(given);
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
    const py::object method = object_->attr("targets"), given = many_neighbourhoods(seen, plan);
    py::list memories;
    for (const Solving& each : solving) {
      if (remembers_) memories.append(memory_of(each));
    }
    const Array places =
        real_array(remembers_ ? method(given, memories) : method(given), name_ + ".targets()");
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
  py::object memory_of(const Solving& solving) const {
    const Memory* memory = solving.memory();
    return memory ? static_cast<const PythonMemory*>(memory)->content()
                  : py::object(object_->attr("new_memory")());
  }

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
  bool together_, remembers_, needs_ids_, needs_waypoint_, gives_forces_, needs_clock_;
};

}  // namespace

void put_behaviour(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  put_class<Behaviour>(type, summary, [](const PythonClass& from, const PythonOptions& options) {
    return std::make_unique<PythonBehaviour>(from.make(options), from.name());
  });
}

}  // namespace shoal::python
