#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// How long the mission lasted, and whether the stop rule of the scenario ended it. How long it
/// could last is energy's endurance.
class Mission final : public Measure {
 public:
  static void declare(Options<Mission>&) {}

  std::vector<Quantity> values() const override {
    return {{"mission_s", "s", "length of the mission, as it was ended"},
            {"stop_watched_s", "s", "how long the stop rule had to end the trial, if there is one"},
            {"stopped_s", "s", "when the stop rule ended the trial", "stop_watched_s"}};
  }

  void finish(const scenarios::World& w, Results& results) const override {
    results.add("mission_s", w.time_s());
    const bool watched = w.stop().watches();
    const auto mission_if = [&](bool held) {
      return held ? std::optional(w.time_s()) : std::nullopt;
    };
    results.add("stop_watched_s", mission_if(watched));
    results.add("stopped_s", mission_if(watched && w.stopped_by() == w.scenario().stop.kind()));
  }
};

const Register<Measure, Mission> registered{"mission",
                                            "how long the mission lasted, and what ended it"};

}  // namespace
}  // namespace shoal::analysis
