#include "shoal/formations/guidances/drift.hpp"

#include <cmath>
#include <numeric>

namespace shoal::formations {
namespace {

// Alg. 2: the mean of the last targets, each relative to the vehicle when it was set.
Eigen::Vector2d smoothed(const Eigen::Vector2d& target, std::size_t size,
                         std::vector<Eigen::Vector2d>& recent) {
  if (size == 1) return target;
  if (recent.size() == size) recent.erase(recent.begin());
  recent.push_back(target);
  const Eigen::Vector2d sum =
      std::accumulate(recent.begin(), recent.end(), Eigen::Vector2d::Zero().eval());
  return sum / static_cast<double>(recent.size());
}

}  // namespace

void DriftOptions::declare(Options<DriftOptions>& o) {
  using G = DriftOptions;
  o.number("speed_m_s", &G::speed_m_s, "m/s", above(0), "transit speed (Table 3.1)");
  o.number("capture_radius_m", &G::capture_radius_m, "m", at_least(0),
           "closer than this the vehicle has arrived");
  o.number("slip_radius_m", &G::slip_radius_m, "m", at_least(0),
           "closer than this, and no longer approaching, it has arrived too");
  o.word("slip", &G::slip, {{"not_closing", Slip::not_closing}, {"receding", Slip::receding}},
         "no longer approaching means: not closer than before (Alg. 1), or further away (the "
         "author's program)");
  o.number("drifting_radius_m", &G::drifting_radius_m, "m", above(0),
           "having arrived it drifts freely until it is further away than this");
  o.number("end_speed_scale", &G::end_speed_scale, "", in(0, 1),
           "share of the speed left at the capture radius; it falls linearly from the drifting "
           "radius");
  o.integer("targets_filter_size", &G::targets_filter_size, "", in(1, 10000),
            "how many targets are averaged (Alg. 2)");
  o.number("period_s", &G::period_s, "s", above(0),
           "how often the command is renewed; the author's helm ran at 4 Hz");
}

std::optional<std::string> DriftOptions::complaint() const {
  if (capture_radius_m <= slip_radius_m && slip_radius_m <= drifting_radius_m &&
      capture_radius_m < drifting_radius_m) {
    return std::nullopt;
  }
  return "the radii must grow: capture_radius_m <= slip_radius_m <= drifting_radius_m";
}

Drift::Drift(const DriftOptions& options) : options_(options) {
  if (const auto wrong = options.complaint()) throw InputError(*wrong);
}

std::unique_ptr<Memory> Drift::new_memory() const {
  return std::make_unique<MemoryOf<State>>();
}

Command Drift::command(const Target&, const Eigen::Vector2d& to_target, const OwnState&,
                       Memory* memory) const {
  State& state = static_cast<MemoryOf<State>*>(memory)->content;
  // Most of the time, most vehicles drift near their targets.
  const double radius = options_.drifting_radius_m;
  const bool near = to_target.squaredNorm() <= radius * radius;
  if (state.drifting && near && options_.targets_filter_size == 1) return {};
  return steer(to_target, state);
}

Command Drift::steer(const Eigen::Vector2d& to_target, State& state) const {
  const auto& [transit_m_s, capture_m, slip_m, drifting_m, slip, end_scale, filter_size, period_s] =
      options_;
  const Eigen::Vector2d target =
      smoothed(to_target, static_cast<std::size_t>(filter_size), state.recent_targets);
  const double distance = target.norm();
  const double previous = std::exchange(state.previous_distance_m, distance);

  const bool slipping =
      slip == DriftOptions::Slip::not_closing ? distance >= previous : distance > previous;
  if (distance > drifting_m) {
    state.drifting = false;
  } else if (distance < capture_m || (distance < slip_m && slipping)) {
    state.drifting = true;
  }
  if (state.drifting) return {};

  double speed = transit_m_s;
  if (distance < drifting_m) {
    // Alg. 1, lines 10-11 and 15-16, with the end speed of Table 3.1: speed x end_speed_scale. The
    // algorithm adds the bare scale, which is a speed only when the transit speed is 1 m/s.
    const double far = (distance - capture_m) / (drifting_m - capture_m);
    speed *= far + end_scale * (1.0 - far);
  }
  return {true, std::atan2(target.y(), target.x()), speed};
}

namespace {

const Register<Guidance, DriftOptions> registered{
    "drift", "to the target, then drifting near it (Rypkema 2015, sec. 3.2)",
    [](const DriftOptions& options) { return std::make_unique<Drift>(options); }};

}  // namespace
}  // namespace shoal::formations
