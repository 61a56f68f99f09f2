#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "shoal/core/angles.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/estimators/estimator.hpp"
#include "shoal/scenarios/estimators/kinematic_model.hpp"
#include "shoal/scenarios/vehicles/nps_auv/controllers.hpp"
#include "shoal/scenarios/vehicles/swarm.hpp"
#include "shoal/scenarios/vehicles/whole_times.hpp"

namespace shoal::scenarios {
namespace {

using formations::Command;

// The world's headings are counter-clockwise from east, the vehicle's clockwise from north.
double turned_over(double angle) {
  return 0.5 * std::numbers::pi - angle;
}

/// A vehicle in six degrees of freedom with its controllers, estimator and disturbances: Barisic et
/// al. 2011, sec. 4 and 5.
struct NpsAuv final : VehicleType {
  double step_s = 0.05;
  double controller_period_s = 0.1;
  double depth_m = 10.0;
  NpsAuvVariant model;
  NpsAuvControllers controllers;
  ProcessNoise disturbance{.on = false};
  Choice<Estimator> estimator{"perfect"};
  double estimator_period_s = 0.5;

  static void declare(Options<NpsAuv>& o);
  std::optional<std::string> complaint() const;

  std::optional<std::string> refuses_tick(double tick_s) const override;
  std::unique_ptr<Swarm> launch(const std::vector<Start>& starts, const Energy& energy,
                                const RandomStreams& random, double tick_s) const override;
};

class NpsAuvSwarm final : public Swarm {
 public:
  NpsAuvSwarm(const NpsAuv& type, const std::vector<Start>& starts, const Energy& energy,
              const RandomStreams& random, double tick_s)
      : Swarm(starts.size()),
        model_(type.model),
        controllers_(type.controllers),
        power_w_(energy, Energy::Law::thrust),
        depth_m_(type.depth_m),
        step_s_(type.step_s),
        steps_(whole_times(tick_s, type.step_s)),
        controller_steps_(whole_times(type.controller_period_s, type.step_s)),
        estimator_steps_(whole_times(type.estimator_period_s, type.step_s)),
        disturbances_(type.disturbance, starts.size(), random, type.estimator_period_s),
        bodies_(starts.size()) {
    believed_m_.resize(starts.size());
    std::vector<VehicleState> states;
    for (const Start& start : starts) {
      VehicleState state = VehicleState::Zero();
      state.segment<3>(6) << start.y_m, start.x_m, depth_m_;
      state(11) = turned_over(start.heading_rad);
      states.push_back(state);
    }
    navigation_ =
        type.estimator.make()->launch(states, type.disturbance, random, type.estimator_period_s);
    for (std::size_t i = 0; i < size(); ++i) {
      Body& body = bodies_[i];
      body.state = states[i];
      body.inputs.reserve(static_cast<std::size_t>(estimator_steps_ / controller_steps_) + 2);
      body.estimate =
          &navigation_->sample(i, 0, body.state, body.water, OwnModel{*this, body, 0, 0});
      body.believed = body.estimate->state;
      body.disturbance = disturbances_.sample(i, 0);
      show(i);
    }
  }

  void advance(std::size_t first, std::size_t last, std::int64_t tick,
               std::span<const Command> commands, std::span<const double> u_m_s,
               std::span<const double> v_m_s) override {
    for (std::size_t i = first; i < last; ++i) {
      Body& body = bodies_[i];
      body.water = {v_m_s[i], u_m_s[i]};
      for (std::int64_t k = tick * steps_; k < (tick + 1) * steps_; ++k) {
        if (k % controller_steps_ == 0 || body.inputs.empty()) {
          body.inputs.push_back({k, control(body.believed, commands[i])});
        }
        const NpsAuvInputs& inputs = body.inputs.back().inputs;
        body.state = model_.integrate(body.state, inputs, step_s_, body.water, body.disturbance);
        const NpsAuvPropulsion propulsion = nps_auv_propulsion(inputs.propeller_rad_s);
        propulsion_j[i] +=
            power_w_(body.state(0), propulsion.thrust_n, propulsion.sustained_m_s, 0.0) * step_s_;
        if (navigation_->exact()) {
          body.believed = body.state;
        } else {
          body.believed = model_.integrate(body.believed, inputs, step_s_, body.estimate->water);
        }
        if ((k + 1) % estimator_steps_ == 0) sample(i, (k + 1) / estimator_steps_);
      }
      show(i);
    }
  }

  formations::OwnState own_state(std::size_t i) const override {
    const VehicleState& x = bodies_[i].believed;
    Eigen::Vector3d over_ground = KinematicModel::velocity(x.tail<3>(), x.head<3>());
    over_ground.head<2>() += navigation_->exact() ? bodies_[i].water : bodies_[i].estimate->water;
    return {.position = {x(7), x(6)},
            .velocity = {over_ground.y(), over_ground.x()},
            .heading_rad = turned_over(x(11)),
            .speed_m_s = x(0),
            .turn_rate_rad_s = -KinematicModel::euler_rates(x.tail<3>(), x)(2)};
  }

  Eigen::Vector2d water_m_s(std::size_t i) const override { return bodies_[i].water.reverse(); }

  const Estimate* estimate(std::size_t i) const override {
    return navigation_->exact() ? nullptr : bodies_[i].estimate;
  }

 private:
  /// Inputs that held from a step on.
  struct Held {
    std::int64_t from;
    NpsAuvInputs inputs;
  };
  struct Body {
    VehicleState state;     // the truth; velocities are relative to the water
    VehicleState believed;  // at the last sample, and carried on by the own model since
    Eigen::Vector2d water = Eigen::Vector2d::Zero();  // the truth: north and east
    const Estimate* estimate = nullptr;
    BodyAcceleration disturbance;
    std::vector<Held> inputs;  // since the last sample
  };

  /// What a vehicle expects of itself between two samples, under the inputs that held.
  struct OwnModel {
    const NpsAuvSwarm& swarm;
    const Body& body;
    std::int64_t begin, end;  // steps

    VehicleState operator()(const VehicleState& x, const Eigen::Vector2d& water) const {
      if (x == body.estimate->state && water == body.estimate->water) {
        return body.believed;  // has been on the way all along
      }
      VehicleState moved = x;
      std::size_t held = 0;
      for (std::int64_t step = begin; step < end; ++step) {
        while (held + 1 < body.inputs.size() && body.inputs[held + 1].from <= step) ++held;
        moved = swarm.model_.integrate(moved, body.inputs[held].inputs, swarm.step_s_, water);
      }
      return moved;
    }
    BodyTangent tangent(const VehicleState& x) const {
      return swarm.model_.tangent(x, body.inputs.back().inputs);
    }
  };

  NpsAuvInputs control(const VehicleState& believed, const Command& command) const {
    if (!command.thrust) return controllers_.drifting(believed, depth_m_);
    return controllers_(believed, {.speed_m_s = command.speed_m_s,
                                   .acceleration_m_s2 = command.acceleration_m_s2,
                                   .heading_rad = turned_over(command.heading_rad),
                                   .turn_rate_rad_s = -command.turn_rate_rad_s,
                                   .depth_m = depth_m_});
  }

  void sample(std::size_t i, std::int64_t k) {
    Body& body = bodies_[i];
    const std::int64_t end = k * estimator_steps_, begin = end - estimator_steps_;
    const auto number = static_cast<std::uint64_t>(k);
    body.estimate =
        &navigation_->sample(i, number, body.state, body.water, OwnModel{*this, body, begin, end});
    body.believed = body.estimate->state;
    body.disturbance = disturbances_.sample(i, number);
    body.inputs.erase(body.inputs.begin(), body.inputs.end() - 1);
  }

  void show(std::size_t i) {
    const VehicleState& state = bodies_[i].state;
    x_m[i] = state(7);
    y_m[i] = state(6);
    depth_m[i] = state(8);
    heading_rad[i] = turned_over(state(11));
    speed_m_s[i] = state(0);
    believed_m_[i] = {bodies_[i].believed(7), bodies_[i].believed(6)};
  }

  NpsAuvModel model_;
  NpsAuvControllers controllers_;
  PropulsionPower power_w_;
  double depth_m_, step_s_;
  std::int64_t steps_, controller_steps_, estimator_steps_;
  Disturbances disturbances_;
  std::unique_ptr<Navigation> navigation_;
  std::vector<Body> bodies_;
};

void NpsAuv::declare(Options<NpsAuv>& o) {
  using V = NpsAuv;
  o.number("step_s", &V::step_s, "s", in(1e-3, 1), "integration step; divides trial.tick_s");
  o.number("controller_period_s", &V::controller_period_s, "s", above(0),
           "period of the controllers; a multiple of step_s");
  o.number("depth_m", &V::depth_m, "m", at_least(0), "depth at mission start, and to be kept");
  o.table("model", &V::model, "doubtful terms of the equations of motion");
  o.table("controllers", &V::controllers, "speed, heading, and depth with pitch");
  o.table("disturbance", &V::disturbance, "what disturbs the motion");
  o.choice("estimator", &V::estimator, "how the vehicle knows its state");
  o.number("estimator_period_s", &V::estimator_period_s, "s", above(0),
           "time between two samples of estimator and disturbance; a multiple of step_s. In "
           "between, the vehicle carries its estimate on by its own model");
}

std::optional<std::string> NpsAuv::complaint() const {
  for (const auto& [name, period_s] : {std::pair("controller_period_s", controller_period_s),
                                       std::pair("estimator_period_s", estimator_period_s)}) {
    if (whole_times(period_s, step_s) > 0) continue;
    return std::string(name) + " is " + shortest(period_s) +
           " s; it must be a multiple of step_s = " + shortest(step_s) + " s";
  }
  return std::nullopt;
}

std::optional<std::string> NpsAuv::refuses_tick(double tick_s) const {
  if (whole_times(tick_s, step_s) > 0) return std::nullopt;
  return "trial.tick_s must be a multiple of the vehicle's step_s = " + shortest(step_s) + " s";
}

std::unique_ptr<Swarm> NpsAuv::launch(const std::vector<Start>& starts, const Energy& energy,
                                      const RandomStreams& random, double tick_s) const {
  return std::make_unique<NpsAuvSwarm>(*this, starts, energy, random, tick_s);
}

const Register<VehicleType, NpsAuv> registered{
    "nps_auv", "NPS Aries class in six degrees of freedom (Barisic et al. 2011, sec. 4)"};

}  // namespace
}  // namespace shoal::scenarios
