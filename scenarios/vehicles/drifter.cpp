#include "shoal/scenarios/vehicles/drifter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shoal/core/angles.hpp"
#include "shoal/scenarios/vehicles/whole_times.hpp"

namespace shoal::scenarios {
namespace {

using formations::Command;

class DrifterSwarm final : public Swarm {
 public:
  DrifterSwarm(const Drifter& type, const std::vector<Start>& starts, const Energy& energy,
               const RandomStreams& random, double tick_s)
      : Swarm(starts.size()),
        type_(type),
        power_w_(energy, Energy::Law::cubic),
        random_(random),
        tick_s_(tick_s),
        steps_(whole_times(tick_s, type.step_s)),
        controller_steps_(whole_times(type.controller_period_s, type.step_s)),
        noise_ticks_(whole_times(type.heading_noise_period_s, tick_s)),
        turn_rate_(radians(type.turn_rate_deg_s)),
        noise_decay_(std::exp(-type.heading_noise_period_s / type.heading_noise_time_s)),
        noise_kick_(radians(type.heading_noise_deg_s) *
                    std::sqrt(1.0 - noise_decay_ * noise_decay_)),
        noise_limit_(radians(type.heading_noise_limit_deg_s)),
        knots_per_m_s_(1.0 / type.drag_knot_m_s),
        per_mass_(type.step_s / type.mass_kg),
        motors_(starts.size()) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      x_m[i] = starts[i].x_m;
      y_m[i] = starts[i].y_m;
      heading_rad[i] = starts[i].heading_rad;
      depth_m[i] = type.start_depth_m;
    }
    // Below the first knot the drag is linear and a tick of gliding is two fixed factors.
    const double lambda = type.step_s * type.drag_n * type.drag_knot_m_s / type.mass_kg;
    glide_speed_ = std::pow(1.0 - lambda, static_cast<double>(steps_));
    glide_path_ = (1.0 - 0.5 * lambda) * type.step_s * (1.0 - glide_speed_) / lambda;
    glides_ = lambda < 1.0;
  }

  void advance(std::size_t first, std::size_t last, std::int64_t tick,
               std::span<const Command> commands, std::span<const double> u_m_s,
               std::span<const double> v_m_s) override {
    if (tick % noise_ticks_ == 0) disturb(first, last, tick / noise_ticks_);
    for (std::size_t i = first; i < last; ++i) {
      x_m[i] += u_m_s[i] * tick_s_;
      y_m[i] += v_m_s[i] * tick_s_;
      if (commands[i].thrust) {
        thrust(i, commands[i], tick);
      } else {
        coast(i);
      }
    }
  }

  formations::OwnState own_state(std::size_t i) const override {
    const Motor& motor = motors_[i];
    const double turning = motor.on ? motor.heading_thrust * turn_rate_ : 0.0;
    formations::OwnState own{.position = {x_m[i], y_m[i]},
                             .heading_rad = heading_rad[i],
                             .speed_m_s = speed_m_s[i],
                             .turn_rate_rad_s = turning + motor.noise_rad_s};
    if (speed_m_s[i] != 0.0) {
      own.velocity =
          speed_m_s[i] * Eigen::Vector2d(std::cos(heading_rad[i]), std::sin(heading_rad[i]));
    }
    return own;
  }

 private:
  /// A turn of the plane.
  struct Turn {
    double cosine, sine;

    // Steps are small turns: their series is exact to rounding and much faster than the functions.
    explicit Turn(double angle) {
      if (std::abs(angle) < 0.05) {
        const double q = angle * angle;
        cosine = 1.0 - q * (1.0 / 2.0 - q * (1.0 / 24.0 - q / 720.0));
        sine = angle * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q / 5040.0)));
      } else {
        cosine = std::cos(angle);
        sine = std::sin(angle);
      }
    }
    Eigen::Vector2d operator*(const Eigen::Vector2d& v) const {
      return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
    }
  };

  struct Motor {
    double noise_rad_s = 0.0;  // of the heading rate
    bool on = false;
    double surge_n = 0.0;
    double heading_thrust = 0.0;                       // -1 .. 1, counter-clockwise
    Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();  // of the heading, while the vehicle moves
    std::array<double, 16> errors{};
    std::size_t newest = 0;
  };

  // The heading rate wanders as an Ornstein-Uhlenbeck process, drawn on its own fixed grid of
  // times, so that it does not depend on what else the vehicle does.
  void disturb(std::size_t first, std::size_t last, std::int64_t index) {
    const auto pair = static_cast<std::uint64_t>(index / 2);
    for (std::size_t i = first; i < last; ++i) {
      Motor& motor = motors_[i];
      if (index % 2 == 0) {
        const auto normals = random_.normal(Purpose::heading, static_cast<std::uint32_t>(i), pair);
        motor_noise(motor, normals[0]);
        spare_[i] = normals[1];
      } else {
        motor_noise(motor, spare_[i]);
      }
    }
  }

  void motor_noise(Motor& motor, double normal) const {
    motor.noise_rad_s = std::clamp(noise_decay_ * motor.noise_rad_s + noise_kick_ * normal,
                                   -noise_limit_, noise_limit_);
  }

  // No thrust and no heading control: the vehicle glides to rest and turns as it is turned.
  void coast(std::size_t i) {
    Motor& motor = motors_[i];
    motor.on = false;
    const double turned = motor.noise_rad_s * tick_s_;
    heading_rad[i] += turned;
    double& speed = speed_m_s[i];
    if (speed == 0.0) return;

    const double before = speed;
    double path = 0.0;
    if (glides_ && speed <= type_.drag_knot_m_s) {
      path = glide_path_ * speed;
      speed *= glide_speed_;
      // Slower than this, what is left of the glide is a centimetre.
      if (speed < 1e-3) speed = 0.0;
    } else {
      for (std::int64_t k = 0; k < steps_; ++k) {
        const double next = std::max(0.0, speed - per_mass_ * drag(speed));
        path += 0.5 * (speed + next) * type_.step_s;
        speed = next;
      }
    }
    const Turn half(0.5 * turned);
    const Eigen::Vector2d along = half * motor.ahead;
    x_m[i] += path * along.x();
    y_m[i] += path * along.y();
    motor.ahead = half * along;
    propulsion_j[i] += power_w_(0.5 * (before + speed), 0.0, 0.0, 0.0) * tick_s_;
  }

  void thrust(std::size_t i, const Command& command, std::int64_t tick) {
    Motor& motor = motors_[i];
    const double course = rounded(command.heading_rad, radians(type_.course_step_deg));
    const double wanted = rounded(command.speed_m_s, type_.speed_step_m_s);
    if (!motor.on) {
      motor.on = true;
      motor.errors.fill(wrapped(course - heading_rad[i]));
      motor.ahead = {std::cos(heading_rad[i]), std::sin(heading_rad[i])};
    }
    const double dt = type_.step_s;
    double heading = heading_rad[i], speed = speed_m_s[i], energy = 0.0;
    double sustained = sustained_m_s(motor.surge_n);
    Eigen::Vector2d moved = Eigen::Vector2d::Zero(), ahead = motor.ahead;
    const auto rate = [&] { return motor.heading_thrust * turn_rate_ + motor.noise_rad_s; };
    Turn half(0.5 * dt * rate());
    const std::int64_t phase = (tick * steps_) % controller_steps_;
    std::int64_t until_control = phase == 0 ? 0 : controller_steps_ - phase;

    for (std::int64_t k = 0; k < steps_; ++k) {
      if (until_control-- == 0) {
        control(motor, course - heading, wanted, command.acceleration_m_s2);
        sustained = sustained_m_s(motor.surge_n);
        half = Turn(0.5 * dt * rate());
        until_control = controller_steps_ - 1;
      }
      const double next = std::max(0.0, speed + per_mass_ * (motor.surge_n - drag(speed)));
      const Eigen::Vector2d along = half * ahead;
      moved += rise(i, 0.5 * (speed + next) * dt) * along;
      ahead = half * along;
      heading += dt * rate();
      speed = next;
      energy += power_w_(speed, motor.surge_n, sustained, motor.heading_thrust) * dt;
    }
    x_m[i] += moved.x();
    y_m[i] += moved.y();
    heading_rad[i] = heading;
    speed_m_s[i] = speed;
    motor.ahead = ahead;
    propulsion_j[i] += energy;
  }

  // PD on the heading; the speed is feed-forward from the drag map (and from the mass, if an
  // acceleration is asked for), and fades with heading error.
  void control(Motor& motor, double error_rad, double wanted_m_s, double wanted_m_s2) const {
    const double error = wrapped(error_rad);
    const auto window = static_cast<std::size_t>(type_.heading_differences);
    const std::size_t size = motor.errors.size();
    const double oldest = motor.errors[(motor.newest + size + 1 - window) % size];
    motor.newest = (motor.newest + 1) % size;
    motor.errors[motor.newest] = error;
    // The mean of the last differences telescopes.
    const double error_rate =
        wrapped(error - oldest) / (static_cast<double>(window) * type_.controller_period_s);
    const double percent = degrees(type_.heading_gain * error + type_.heading_damping * error_rate);
    motor.heading_thrust = std::clamp(percent / 100.0, -1.0, 1.0);
    const double aligned = std::max(0.0, 1.0 - std::abs(degrees(error)) / type_.heading_limit_deg);
    motor.surge_n = aligned * drag(std::min(wanted_m_s, type_.max_speed_m_s));
    if (wanted_m_s2 != 0.0) {
      motor.surge_n = std::clamp(motor.surge_n + aligned * type_.mass_kg * wanted_m_s2, 0.0,
                                 drag(type_.max_speed_m_s));
    }
  }

  // drag_n v^2 at the knots of the drag map, linear between them: the chord of v^2. v >= 0.
  double drag(double v) const {
    const double low =
        static_cast<double>(static_cast<std::int64_t>(v * knots_per_m_s_)) * type_.drag_knot_m_s;
    return type_.drag_n * (low * low + (v - low) * (2.0 * low + type_.drag_knot_m_s));
  }

  /// The speed at which a thrust balances the drag, without the chords of its map.
  double sustained_m_s(double thrust_n) const { return std::sqrt(thrust_n / type_.drag_n); }

  /// The horizontal part of a path; below the surface the vehicle pitches up and rises along it.
  double rise(std::size_t i, double path) {
    if (depth_m[i] <= 0.0) return path;
    const double pitch =
        radians(std::min(type_.pitch_limit_deg, type_.pitch_gain_deg_m * depth_m[i]));
    depth_m[i] = std::max(0.0, depth_m[i] - path * std::sin(pitch));
    return path * std::cos(pitch);
  }

  static double rounded(double value, double step) {
    return step > 0.0 ? step * std::round(value / step) : value;
  }

  Drifter type_;
  PropulsionPower power_w_;
  RandomStreams random_;
  double tick_s_;
  std::int64_t steps_, controller_steps_, noise_ticks_;
  double turn_rate_, noise_decay_, noise_kick_, noise_limit_;
  double knots_per_m_s_, per_mass_;
  double glide_speed_ = 0.0, glide_path_ = 0.0;
  bool glides_ = false;
  std::vector<Motor> motors_;
  std::vector<double> spare_ = std::vector<double>(motors_.size());  // second normal of each pair
};

}  // namespace

void Drifter::declare(Options<Drifter>& o) {
  using D = Drifter;
  o.number("mass_kg", &D::mass_kg, "kg", above(0), "mass");
  o.number("drag_n", &D::drag_n, "N", above(0), "drag at 1 m/s; it grows with the square");
  o.number("drag_knot_m_s", &D::drag_knot_m_s, "m/s", above(0),
           "spacing of the drag map's knots; between them the drag is linear");
  o.number("max_speed_m_s", &D::max_speed_m_s, "m/s", above(0), "speed at full thrust");
  o.number("turn_rate_deg_s", &D::turn_rate_deg_s, "deg/s", above(0),
           "turn rate at full heading thrust");
  o.number("heading_gain", &D::heading_gain, "%/deg", at_least(0),
           "heading thrust per heading error");
  o.number("heading_damping", &D::heading_damping, "% s/deg", at_least(0),
           "heading thrust per rate of the heading error");
  o.integer("heading_differences", &D::heading_differences, "", in(1, 15),
            "how many differences the rate of the heading error is averaged over");
  o.number("heading_limit_deg", &D::heading_limit_deg, "deg", above(0),
           "no thrust ahead while the heading error is larger");
  o.number("heading_noise_deg_s", &D::heading_noise_deg_s, "deg/s", at_least(0),
           "standard deviation of the wandering heading rate; the default wanders by 20 deg rms in "
           "60 s, as in the author's log");
  o.number("heading_noise_time_s", &D::heading_noise_time_s, "s", above(0),
           "correlation time of the wandering heading rate");
  o.number("heading_noise_limit_deg_s", &D::heading_noise_limit_deg_s, "deg/s", at_least(0),
           "the wandering heading rate is limited to this");
  o.number("heading_noise_period_s", &D::heading_noise_period_s, "s", above(0),
           "how often the wandering heading rate is drawn; a multiple of trial.tick_s");
  o.number("course_step_deg", &D::course_step_deg, "deg", at_least(0),
           "courses are rounded to multiples of this, as by the author's helm (0: not)");
  o.number("speed_step_m_s", &D::speed_step_m_s, "m/s", at_least(0),
           "speeds are rounded to multiples of this (0: not)");
  o.number("step_s", &D::step_s, "s", above(0), "integration step; divides trial.tick_s");
  o.number("controller_period_s", &D::controller_period_s, "s", above(0),
           "period of the heading and speed controller; a multiple of step_s");
  o.number("start_depth_m", &D::start_depth_m, "m", at_least(0),
           "depth at mission start; vehicles rise while they thrust (the author's: 100)");
  o.number("pitch_limit_deg", &D::pitch_limit_deg, "deg", in(0, 89), "steepest pitch when rising");
  o.number("pitch_gain_deg_m", &D::pitch_gain_deg_m, "deg/m", at_least(0),
           "pitch per metre of depth, up to the limit");
}

std::optional<std::string> Drifter::complaint() const {
  if (whole_times(controller_period_s, step_s) == 0) {
    return "controller_period_s must be a multiple of step_s";
  }
  const double steepest = 2.0 * drag_n * std::max(max_speed_m_s, drag_knot_m_s) / mass_kg;
  if (steepest * step_s >= 1.0) {
    return "step_s is too long for this drag and mass; the speed would oscillate above " +
           std::to_string(1.0 / steepest) + " s";
  }
  return std::nullopt;
}

std::optional<std::string> Drifter::refuses_tick(double tick_s) const {
  if (whole_times(tick_s, step_s) == 0)
    return "trial.tick_s must be a multiple of the vehicle's step_s";
  if (whole_times(heading_noise_period_s, tick_s) == 0) {
    return "the vehicle's heading_noise_period_s must be a multiple of trial.tick_s";
  }
  return std::nullopt;
}

std::unique_ptr<Swarm> Drifter::launch(const std::vector<Start>& starts, const Energy& energy,
                                       const RandomStreams& random, double tick_s) const {
  return std::make_unique<DrifterSwarm>(*this, starts, energy, random, tick_s);
}

namespace {
const Register<VehicleType, Drifter> registered{
    "drifter", "drag and turn in place, the thesis' vehicle (Rypkema 2015, sec. 4.1)"};
}  // namespace

}  // namespace shoal::scenarios
