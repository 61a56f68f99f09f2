#pragma once

#include <Eigen/Core>

#include "shoal/core/options.hpp"
#include "shoal/scenarios/estimators/kinematic_model.hpp"

namespace shoal::scenarios {

/// The positions of what a vehicle of the NPS Aries class is driven by.
struct NpsAuvInputs {
  double rudder_rad = 0.0;               ///< delta_r; above 0 turns to port
  double stern_planes_rad = 0.0;         ///< delta_s; above 0 puts the nose down
  double bow_plane_port_rad = 0.0;       ///< delta_bp; eq. 30 has no bow planes (C1)
  double bow_plane_starboard_rad = 0.0;  ///< delta_bs
  double propeller_rad_s = 0.0;          ///< n
};

/// Doubtful corrections (notebooks/corrections.md), which a user may want to decide otherwise.
struct NpsAuvVariant {
  bool pitch_arm_of_mss = false;  ///< pitch moment with w + xq instead of w - xq (C24)
  /// L in C_t: in feet, as its disc area seems to be (C30).
  double propeller_length = 5.3 / 0.3048;

  static void declare(Options<NpsAuvVariant>& o);
};

/// The six equations of motion of Barisic et al. 2011, eq. 31-40 with Table 1, after Healey and
/// Lienard 1993: a cuboid hull with quadratic cross-flow drag, corrected as C18 to C35.
///
/// States are those of VehicleState with velocities relative to the water, forces in N and N m
/// about the origin of the body frame. Immutable, thread-safe, allocates nothing.
class NpsAuvModel {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit NpsAuvModel(const NpsAuvVariant& variant = {});

  /// Rigid body and added mass.
  const Matrix6& mass_matrix() const { return mass_; }

  /// F of M nu' = F: hydrodynamics, weight and propeller, less the products of velocities that the
  /// rigid body brings along.
  Vector6 forces(const VehicleState& state, const NpsAuvInputs& inputs) const;

  /// What the propeller's race adds to the effect of the stern planes, eq. 39.
  double epsilon(double u_m_s, double propeller_rad_s) const;

  /// The derivative of the state. `water` is the velocity of the water (m/s, north and east), which
  /// carries the vehicle along; `disturbance` is added to the accelerations of the body.
  ///
  /// Not finite where the nose points straight up or down.
  VehicleState derivative(const VehicleState& state, const NpsAuvInputs& inputs,
                          const Eigen::Vector2d& water = Eigen::Vector2d::Zero(),
                          const Vector6& disturbance = Vector6::Zero()) const;

  /// How the accelerations of the body change with its velocities, roll and pitch: differences.
  BodyTangent tangent(const VehicleState& state, const NpsAuvInputs& inputs) const;

  /// One step of the classical Runge-Kutta method of fourth order.
  VehicleState integrate(const VehicleState& state, const NpsAuvInputs& inputs, double step_s,
                         const Eigen::Vector2d& water = Eigen::Vector2d::Zero(),
                         const Vector6& disturbance = Vector6::Zero()) const;

 private:
  NpsAuvVariant variant_;
  Matrix6 mass_, inverse_mass_;
  double race_at_rest_;
};

/// Of the design point of eq. 42: 500 revolutions a minute drive the vehicle at 1.832 m/s (C28).
inline constexpr double nps_auv_speed_per_revolution_m = 1.832 / 52.359;

/// The thrust of the propeller (eq. 38 with C28, N) and the speed that it keeps up.
struct NpsAuvPropulsion {
  double thrust_n, sustained_m_s;
};
NpsAuvPropulsion nps_auv_propulsion(double propeller_rad_s);

/// Surge: m - X_u' (kg), and the drag coefficient of eq. 42 times rho L^2 / 2 (kg/m).
struct NpsAuvSurge {
  double mass_kg, drag_kg_m;
};
NpsAuvSurge nps_auv_surge();

}  // namespace shoal::scenarios
