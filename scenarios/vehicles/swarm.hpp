#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shoal/core/random.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/formations/guidance.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/scenarios/energy.hpp"
#include "shoal/scenarios/starts/start.hpp"

namespace shoal::scenarios {

struct Estimate;

/// The vehicles of a swarm, all of one type, in contiguous arrays.
class Swarm {
 public:
  explicit Swarm(std::size_t size)
      : x_m(size),
        y_m(size),
        depth_m(size),
        heading_rad(size),
        speed_m_s(size),
        propulsion_j(size) {}
  virtual ~Swarm() = default;

  std::size_t size() const { return x_m.size(); }

  /// Where a vehicle believes that it is, and how it moves: the truth, unless its type estimates.
  Eigen::Vector2d own_position(std::size_t i) const {
    return believed_m_.empty() ? Eigen::Vector2d(x_m[i], y_m[i]) : believed_m_[i];
  }
  virtual formations::OwnState own_state(std::size_t i) const = 0;
  /// The water's velocity (east and north) that a vehicle with an estimator last moved in.
  virtual Eigen::Vector2d water_m_s(std::size_t i) const {
    (void)i;
    return Eigen::Vector2d::Zero();
  }
  /// The last sample of its estimator, if its type has one.
  virtual const Estimate* estimate(std::size_t i) const {
    (void)i;
    return nullptr;
  }

  /// Advances vehicles [first, last) from the given tick to the next one.
  ///
  /// `commands` and the water's velocity (m/s, east and north) hold during the tick and are indexed
  /// like the swarm. Vehicles do not influence one another: disjoint ranges may run in parallel.
  virtual void advance(std::size_t first, std::size_t last, std::int64_t tick,
                       std::span<const formations::Command> commands, std::span<const double> u_m_s,
                       std::span<const double> v_m_s) = 0;

  std::vector<double> x_m, y_m;      ///< east and north of the origin
  std::vector<double> depth_m;       ///< positive down
  std::vector<double> heading_rad;   ///< counter-clockwise from east
  std::vector<double> speed_m_s;     ///< forward, through water
  std::vector<double> propulsion_j;  ///< electrical energy spent on thrust and turning

 protected:
  /// Own positions of a type that estimates them, kept up to date by it; empty for any other.
  std::vector<Eigen::Vector2d> believed_m_;
};

/// A type of vehicle.
class VehicleType {
 public:
  static constexpr const char* family = "vehicle";
  static constexpr const char* family_meaning = "how a vehicle moves";

  virtual ~VehicleType() = default;

  /// Why this type cannot run with such a tick, or nothing if it can.
  virtual std::optional<std::string> refuses_tick(double tick_s) const = 0;

  virtual std::unique_ptr<Swarm> launch(const std::vector<Start>& starts, const Energy& energy,
                                        const RandomStreams& random, double tick_s) const = 0;
};

}  // namespace shoal::scenarios
