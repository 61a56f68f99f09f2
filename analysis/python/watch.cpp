#include "watch.hpp"

#include <chrono>

#include "potentials.hpp"
#include "python_class.hpp"
#include "shoal/analysis/experiments/trial.hpp"

namespace shoal::python {
namespace {

class Watch final : public scenarios::Observer {
 public:
  Watch(const scenarios::Scenario& scenario, py::object progress)
      : progress_(std::move(progress)),
        every_s_(analysis::watching_interval_s(scenario)),
        duration_s_(scenario.trial.duration_s),
        calls_for_each_number_(has_scalar_function(scenarios::resolved_scenario(scenario))) {}

  double every_s() const override { return every_s_; }

  void observe(const scenarios::World& world) override {
    constexpr std::chrono::milliseconds pause(500);
    const Clock::time_point now = Clock::now();
    if (now - last_ < pause) return;
    last_ = now;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) report(world.time_s(), now);
    if (hint_due_ && now - began_ >= patience) hint(world);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void report(double time_s, Clock::time_point now) const {
    py::dict reached;
    reached["time_s"] = time_s;
    reached["duration_s"] = duration_s_;
    reached["elapsed_s"] = std::chrono::duration<double>(now - began_).count();
    progress_(reached);
  }

  void hint(const scenarios::World& world) {
    hint_due_ = false;
    const char* text = nullptr;
    if (calls_for_each_number_) {
      text =
          "this run calls a Python function for each number; written for arrays, with "
          "shoal.potential(law, batch=True), it runs some hundred times faster";
    } else if (is_class("behaviour", world.scenario().behaviour.kind()) &&
               !world.behaviour().plans_together()) {
      text =
          "this run calls target() of a Python class for each vehicle; with targets(), for all "
          "that plan at an instant, it runs faster";
    }
    if (text && PyErr_WarnEx(PyExc_RuntimeWarning, text, 1) != 0) throw py::error_already_set();
  }

  static constexpr std::chrono::seconds patience{5};

  py::object progress_;
  double every_s_, duration_s_;
  bool calls_for_each_number_, hint_due_ = true;
  Clock::time_point began_ = Clock::now(), last_ = began_;
};

}  // namespace

std::unique_ptr<scenarios::Observer> watch(const scenarios::Scenario& scenario,
                                           py::object progress) {
  return std::make_unique<Watch>(scenario, std::move(progress));
}

std::function<void()> python_signals() {
  using Clock = std::chrono::steady_clock;
  return [last = Clock::now()]() mutable {
    constexpr std::chrono::milliseconds pause(200);
    const Clock::time_point now = Clock::now();
    if (now - last < pause) return;
    last = now;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
}

}  // namespace shoal::python
