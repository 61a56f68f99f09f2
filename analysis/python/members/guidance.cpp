#include <cmath>

#include "../python_class.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/guidance.hpp"

namespace shoal::python {
namespace {

using formations::Command;
using formations::Guidance;
using formations::OwnState;
using formations::Target;

/// A class with a method command(to_target, own) that returns heading and speed, or None.
class PythonGuidance final : public Guidance {
 public:
  PythonGuidance(std::shared_ptr<const Held> object, std::string name)
      : object_(std::move(object)), name_(std::move(name)) {
    const py::gil_scoped_acquire held;
    if (!object_->has("command")) {
      throw InputError("the class " + name_ + " has no method command(to_target, own)");
    }
    period_s_ = positive("period_s");
    highest_speed_m_s_ = positive("highest_speed_m_s");
    takes_forces_ = object_->flag("takes_forces");
    needs_motion_ = object_->flag("needs_motion");
    if (object_->has("drifting_radius_m")) drifting_radius_m_ = positive("drifting_radius_m");
  }

  Command command(const Target& target, const Eigen::Vector2d& to_target, const OwnState& own,
                  Memory*) const override {
    const py::gil_scoped_acquire held;
    const Eigen::Vector2d given =
        takes_forces_ ? target.force_m_s2.value_or(Eigen::Vector2d::Zero()) : to_target;
    const py::object answer = object_->attr("command")(given, own);
    if (answer.is_none()) return {};
    const Array numbers = real_array(answer, name_ + ".command()");
    if (numbers.ndim() != 1 || numbers.size() != 2) refuse("(heading_rad, speed_m_s), or None");
    const double heading = numbers.at(0), speed = numbers.at(1);
    if (!std::isfinite(heading)) refuse("a finite heading");
    if (!(speed >= 0.0 && speed <= highest_speed_m_s_)) {
      refuse("a speed from 0 to its highest_speed_m_s, " + shortest(highest_speed_m_s_));
    }
    return {.thrust = true, .heading_rad = heading, .speed_m_s = speed};
  }

  double period_s() const override { return period_s_; }
  bool takes_forces() const override { return takes_forces_; }
  bool needs_motion() const override { return needs_motion_; }
  double highest_speed_m_s() const override { return highest_speed_m_s_; }
  std::optional<double> drifting_radius_m() const override { return drifting_radius_m_; }

 private:
  double positive(const char* attribute) const {
    if (!object_->has(attribute)) {
      throw InputError("the class " + name_ + " has no " + attribute + "; give it a number");
    }
    const double x =
        number_argument(object_->attr(attribute), std::string(attribute) + " of " + name_);
    if (x > 0.0 && std::isfinite(x)) return x;
    throw InputError(std::string(attribute) + " of " + name_ + " is " + shortest(x) +
                     "; it takes a finite number above 0");
  }

  [[noreturn]] void refuse(const std::string& wanted) const {
    throw InputError(name_ + ".command() has to return " + wanted);
  }

  std::shared_ptr<const Held> object_;
  std::string name_;
  double period_s_ = 0.0, highest_speed_m_s_ = 0.0;
  bool takes_forces_ = false, needs_motion_ = false;
  std::optional<double> drifting_radius_m_;
};

}  // namespace

void put_guidance(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  put_class<Guidance>(type, summary, [](const PythonClass& from, const PythonOptions& options) {
    return std::make_unique<PythonGuidance>(from.make(options), from.name());
  });
}

}  // namespace shoal::python
