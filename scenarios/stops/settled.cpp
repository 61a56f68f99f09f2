#include <algorithm>

#include "shoal/core/text.hpp"
#include "shoal/scenarios/stops/stop_rule.hpp"

namespace shoal::scenarios {
namespace {

/// The formation quality no longer changes: all its values within the last `window_s` lie within
/// `threshold_m` of one another. Rypkema 2015, sec. 4.4.1.
///
/// The thesis says that a construction trial is stopped "once the change in the metric value falls
/// below a specified threshold", and gives neither the threshold nor over what time; the author's
/// program has no such rule. The change is taken as the spread over a window, not as the difference
/// of its ends: a quality that swings would pass that by chance. A swarm that has not begun to move
/// is settled, too, so that the window must be longer than it takes to hear the first pings; with
/// losses, `not_before_s` keeps the trial going until they have happened.
struct Settled final : StopRule {
  double threshold_m = 3.0;
  double window_s = 300.0;
  double not_before_s = 0.0;

  bool needs_quality() const override { return true; }

  std::optional<std::string> refuses_quality_every(double every_s) const override {
    if (every_s <= 0.0) return "needs the formation quality; set quality.every_s above 0";
    if (every_s <= window_s) return std::nullopt;
    return "window_s is " + shortest(window_s) +
           " s, shorter than quality.every_s = " + shortest(every_s) + " s; make it at least that";
  }

  bool met(const QualitySoFar& quality) const override {
    if (quality.time_s.empty()) return false;
    const double now_s = quality.time_s.back(), from_s = now_s - window_s;
    if (now_s < not_before_s || quality.time_s.front() > from_s) return false;
    const auto first = std::ranges::lower_bound(quality.time_s, from_s);
    const auto within =
        quality.quality_m.subspan(static_cast<std::size_t>(first - quality.time_s.begin()));
    const auto [least, greatest] = std::ranges::minmax(within);
    return greatest - least <= threshold_m;
  }

  static void declare(Options<Settled>& o) {
    using S = Settled;
    o.number("threshold_m", &S::threshold_m, "m", above(0),
             "largest change of the formation quality within the window");
    o.number("window_s", &S::window_s, "s", above(0),
             "how long the quality must have changed by no more than that");
    o.number("not_before_s", &S::not_before_s, "s", at_least(0),
             "the trial goes on at least until then, as for losses to come");
  }
};

const Register<StopRule, Settled> registered{
    "settled", "the formation quality has not changed for a while (Rypkema 2015, sec. 4.4.1)"};

}  // namespace
}  // namespace shoal::scenarios
