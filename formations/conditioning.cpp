#include "shoal/formations/conditioning.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::formations {

AdmissibleSet::AdmissibleSet(const PerformanceEnvelope& envelope, const Motion& motion,
                             double period_s) {
  const double T = period_s;
  const double now = motion.speed_m_s / T;
  const double slowest = envelope.speed_min_m_s / T;
  const double fastest = envelope.speed_max_m_s / T;
  const double change = envelope.acceleration_max_m_s2;
  size_min_m_s2 = std::clamp(now - change, slowest, fastest);
  size_max_m_s2 = std::clamp(now + change, slowest, fastest);

  // Eq. 88 prints T^2/2, which contradicts eq. 84 (C57).
  const double widest = T * envelope.turn_rate_max_rad_s;
  const double turning = T * motion.turn_rate_rad_s;
  const double swing = T * T * envelope.turn_acceleration_max_rad_s2;
  turn_min_rad = std::clamp(turning - swing, -widest, widest);
  turn_max_rad = std::clamp(turning + swing, -widest, widest);

  reachable = now - change <= fastest && now + change >= slowest && turning - swing <= widest &&
              turning + swing >= -widest;
}

ConditionedCommand conditioned(const Eigen::Vector2d& force, const Motion& motion, double period_s,
                               const PerformanceEnvelope& envelope) {
  const AdmissibleSet allowed(envelope, motion, period_s);
  const double now = motion.speed_m_s / period_s;
  const double largest = allowed.size_max_m_s2;
  const bool accelerating = force.x() > 0.0;

  // The velocity after one period, over the period.
  double ahead = force.x() + now;
  double aside = force.y();
  const double wanted = std::hypot(ahead, aside);
  if (wanted > largest || wanted < allowed.size_min_m_s2 || ahead < 0.0) {
    const auto aside_within = [&](double limit) {
      return std::copysign(std::min(std::abs(aside), limit), aside);
    };
    if (accelerating) {
      aside = aside_within(largest);
      ahead = std::sqrt(largest * largest - aside * aside);
    } else {
      const double slowest = std::max(0.0, now - envelope.acceleration_max_m_s2);
      ahead = std::clamp(ahead, std::min(slowest, largest), largest);
      aside = aside_within(std::sqrt(largest * largest - ahead * ahead));
    }
  }

  const double turn = std::atan2(aside, ahead);  // C56
  const double kept = std::clamp(turn, allowed.turn_min_rad, allowed.turn_max_rad);
  double size = std::hypot(ahead, aside);
  if (kept != turn) {
    // Accelerating, onto the nearest point of the limiting ray (C62); braking, at the same speed
    // along the heading.
    size = accelerating ? size * std::cos(turn - kept) : ahead / std::cos(kept);
  }
  // Either may leave the annulus.
  size = std::clamp(size, allowed.size_min_m_s2, largest);

  const double speed = period_s * size;
  return {.speed_m_s = speed,
          .acceleration_m_s2 = (speed - motion.speed_m_s) / period_s,
          .turn_rad = kept,
          .turn_rate_rad_s = kept / period_s,
          .force = {size * std::cos(kept) - now, size * std::sin(kept)},
          .reachable = allowed.reachable};
}

Command commanded(const Eigen::Vector2d& force, const OwnState& own, double period_s,
                  const PerformanceEnvelope& envelope) {
  const double c = std::cos(own.heading_rad), s = std::sin(own.heading_rad);
  const Eigen::Vector2d in_body(c * force.x() + s * force.y(), c * force.y() - s * force.x());
  const ConditionedCommand made =
      conditioned(in_body, {own.speed_m_s, own.turn_rate_rad_s}, period_s, envelope);
  return {.thrust = true,
          .heading_rad = own.heading_rad + made.turn_rad,
          .speed_m_s = made.speed_m_s,
          .acceleration_m_s2 = made.acceleration_m_s2,
          .turn_rate_rad_s = made.turn_rate_rad_s,
          .outside_envelope = !made.reachable};
}

void PerformanceEnvelope::declare(Options<PerformanceEnvelope>& o) {
  using E = PerformanceEnvelope;
  o.number("speed_max_m_s", &E::speed_max_m_s, "m/s", above(0), "highest forward speed");
  o.number("speed_min_m_s", &E::speed_min_m_s, "m/s", at_least(0), "lowest forward speed");
  o.number("acceleration_max_m_s2", &E::acceleration_max_m_s2, "m/s2", above(0),
           "fastest change of the forward speed");
  o.number("turn_rate_max_rad_s", &E::turn_rate_max_rad_s, "rad/s", above(0), "fastest turn");
  o.number("turn_acceleration_max_rad_s2", &E::turn_acceleration_max_rad_s2, "rad/s2", above(0),
           "fastest change of the turn rate");
}

std::optional<std::string> PerformanceEnvelope::complaint() const {
  if (speed_min_m_s <= speed_max_m_s) return std::nullopt;
  return "speed_min_m_s is " + shortest(speed_min_m_s) + ", above speed_max_m_s of " +
         shortest(speed_max_m_s) + "; make it smaller";
}

}  // namespace shoal::formations
