#include "shoal/scenarios/vehicles/nps_auv/hydrodynamics.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "shoal/scenarios/estimators/kinematic_model.hpp"

namespace shoal::scenarios {
namespace {

// Table 1 as corrected (notebooks/corrections.md). Coefficients are named as in the chapter: X_vr
// multiplies v r in surge. Units: SI.
constexpr double weight = 53.4e3, buoyancy = 53.4e3, length = 5.3, density = 1000.0, mass = 5454.54;
constexpr double I_x = 2038.0, I_y = 13587.0, I_z = 13587.0;  // C32
constexpr double I_xy = -13.58, I_yz = -13.58, I_xz = -13.58;
constexpr double x_G = 0.0, y_G = 0.0, z_G = 0.061, x_B = 0.0, y_B = 0.0, z_B = 0.0;

constexpr double k2 = 0.5 * density * length * length;
constexpr double k3 = k2 * length, k4 = k3 * length, k5 = k4 * length;

namespace X {
constexpr double pp = 7.0e-3, qq = -1.5e-2, rr = 4.0e-3, pr = 7.5e-4, u_dot = -7.6e-3, wq = -2.0e-1,
                 vp = -3.0e-3, vr = 2.0e-2, q_ds = 2.5e-2, q_db2 = -1.3e-3, r_dr = -1.0e-3,
                 vv = 5.3e-2, ww = 1.7e-1, v_dr = 1.7e-3, w_ds = 4.6e-2, w_db2 = 0.5e-2,
                 ds_ds = -1.0e-2, db_db2 = -4.0e-3, dr_dr = -1.0e-2, q_ds_n = 2.0e-3,
                 w_ds_n = 3.5e-3, ds_ds_n = -1.6e-3;
}
namespace Y {
constexpr double p_dot = 1.2e-4, r_dot = 1.2e-3, pq = 4.0e-3, qr = -6.5e-3, v_dot = -5.5e-2,
                 p = 3.0e-3, r = 3.0e-2, vq = 2.4e-2, wp = 2.3e-1, wr = -1.9e-2, v = -1.0e-1,
                 vw = 6.8e-2, dr = 2.7e-2;
}
namespace Z {
constexpr double q_dot = -6.8e-3, pp = 1.3e-4, pr = 6.7e-3, rr = -7.4e-3, w_dot = -2.4e-1,
                 q = -1.4e-1 /* C33 */, vp = -4.8e-2, vr = 4.5e-2, w = -3.0e-1, vv = -6.8e-2,
                 ds = -7.3e-2, db2 = -1.3e-2, q_n = -2.9e-3, w_n = -5.1e-3, ds_n = -1.0e-2;
}
namespace K {
constexpr double p_dot = -1.0e-3, r_dot = -3.4e-5, pq = -6.9e-5, qr = 1.7e-2,
                 v_dot = 1.2e-4 /* C35 */, p = -1.1e-2, r = -8.4e-4, vq = -5.1e-3, wp = -1.3e-4,
                 wr = 1.4e-2, v = 3.1e-3, vw = -1.9e-1, db2 = 0.0, p_n = -5.7e-4, prop = 0.0;
}
namespace M {
constexpr double q_dot = -1.7e-2, pp = 5.3e-5, pr = 5.0e-3, rr = 2.9e-3, w_dot = -6.8e-3 /* C34 */,
                 q = -6.8e-2, vp = 1.2e-3, vr = 1.7e-2, w = 1.0e-1, vv = -2.6e-2, ds = -4.1e-2,
                 db2 = 3.5e-3, q_n = -1.6e-3, w_n = -2.9e-3, ds_n = -5.2e-3;
}
namespace N {
constexpr double p_dot = -3.4e-5, r_dot = -3.4e-3, pq = -2.1e-2, qr = 2.7e-3, v_dot = 1.2e-3,
                 p = -8.4e-4, r = -1.6e-2, vq = -1.0e-2, wp = -1.7e-2, wr = 7.4e-3, v = -7.4e-3,
                 vw = -2.7e-2, dr = -1.3e-2, prop = 0.0;
}

// C27: the hull of the MSS toolbox, a box, since the chapter gives neither shape nor drag.
constexpr double hull_height = 0.53, hull_breadth = 0.53, C_dy = 0.5, C_dz = 0.6;
constexpr double C_d0 = 0.00385;  // eq. 38
constexpr double C_d = 0.0034;    // eq. 42

/// Half the density times the integrals along the hull of the cross-flow drag per length, eq. 37.
struct CrossFlow {
  double sway, heave;               // N
  double pitch, pitch_of_mss, yaw;  // N m; the arm is x
};

/// By Simpson's rule on 20 panels.
class Hull {
 public:
  Hull() {
    for (int i = 0; i < nodes; ++i) {
      x_[i] = length * (static_cast<double>(i) / (nodes - 1) - 0.5);
      const double simpson = i == 0 || i == nodes - 1 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      weight_[i] = 0.5 * density * simpson * length / (3.0 * (nodes - 1));
    }
  }

  CrossFlow cross_flow(double v, double w, double q, double r, bool of_mss) const {
    const Line across = v + x_ * r, down = w - x_ * q;
    const Line across2 = across.square(), down2 = down.square();
    // Where nothing flows the drag is zero: its numerator falls faster than U_cf.
    const Line drag = weight_ * (C_dy * hull_height * across2 + C_dz * hull_breadth * down2) *
                      (across2 + down2 + 1e-200).rsqrt();
    const Line sway = drag * across, heave = drag * down;
    CrossFlow all{sway.sum(), heave.sum(), (heave * x_).sum(), 0.0, (sway * x_).sum()};
    if (of_mss) all.pitch_of_mss = (drag * (w + x_ * q) * x_).sum();
    return all;
  }

 private:
  static constexpr int nodes = 21;
  using Line = Eigen::Array<double, nodes, 1>;
  Line x_, weight_;
};

const Hull& hull() {
  static const Hull made;
  return made;
}

NpsAuvModel::Matrix6 whole_mass() {
  NpsAuvModel::Matrix6 rigid;
  // [m 1, -m S(r_G); m S(r_G), I]
  rigid << mass, 0, 0, 0, mass * z_G, -mass * y_G,    //
      0, mass, 0, -mass * z_G, 0, mass * x_G,         //
      0, 0, mass, mass * y_G, -mass * x_G, 0,         //
      0, -mass * z_G, mass * y_G, I_x, -I_xy, -I_xz,  //
      mass * z_G, 0, -mass * x_G, -I_xy, I_y, -I_yz,  //
      -mass * y_G, mass * x_G, 0, -I_xz, -I_yz, I_z;
  NpsAuvModel::Matrix6 added = NpsAuvModel::Matrix6::Zero();
  added(0, 0) = -k3 * X::u_dot;
  added(1, 1) = -k3 * Y::v_dot;
  added(2, 2) = -k3 * Z::w_dot;
  added(1, 3) = -k4 * Y::p_dot;
  added(1, 5) = -k4 * Y::r_dot;
  added(2, 4) = -k4 * Z::q_dot;
  added(3, 1) = -k4 * K::v_dot;
  added(4, 2) = -k4 * M::w_dot;
  added(5, 1) = -k4 * N::v_dot;
  added(3, 3) = -k5 * K::p_dot;
  added(3, 5) = -k5 * K::r_dot;
  added(4, 4) = -k5 * M::q_dot;
  added(5, 3) = -k5 * N::p_dot;
  added(5, 5) = -k5 * N::r_dot;
  return rigid + added;
}

}  // namespace

void NpsAuvVariant::declare(Options<NpsAuvVariant>& o) {
  using V = NpsAuvVariant;
  o.flag("pitch_arm_of_mss", &V::pitch_arm_of_mss,
         "pitch moment of the cross-flow with w + xq, as in the MSS toolbox, instead of the moment "
         "of the force");
  o.number("propeller_length", &V::propeller_length, "", above(0),
           "L of the propeller's C_t: 17.388 ft (5.3 m), or 5.3 (m) as in the MSS toolbox");
}

NpsAuvPropulsion nps_auv_propulsion(double propeller_rad_s) {
  const double speed = nps_auv_speed_per_revolution_m * propeller_rad_s;
  return {k2 * C_d0 * speed * std::abs(speed), speed};
}

NpsAuvSurge nps_auv_surge() {
  return {mass - k3 * X::u_dot, C_d * k2};
}

NpsAuvModel::NpsAuvModel(const NpsAuvVariant& variant)
    : variant_(variant), mass_(whole_mass()), inverse_mass_(mass_.inverse()) {
  const double C_t1 = 0.008 * variant.propeller_length * variant.propeller_length / 2.0;
  race_at_rest_ = std::sqrt(C_t1 + 1.0) - 1.0;
}

double NpsAuvModel::epsilon(double u, double n) const {
  // Eq. 39-40 with C28-C31: without the guards the root turns imaginary astern.
  const double eta = nps_auv_speed_per_revolution_m * n / std::max(std::abs(u), 0.05);
  const double C_t =
      0.008 * variant_.propeller_length * variant_.propeller_length * eta * std::abs(eta) / 2.0;
  const double race = (std::sqrt(1.0 + std::abs(C_t)) - 1.0) / race_at_rest_;
  return -1.0 + std::copysign(race, n) * (u < 0.0 ? -1.0 : 1.0);
}

NpsAuvModel::Vector6 NpsAuvModel::forces(const VehicleState& x, const NpsAuvInputs& in) const {
  const double u = x(0), v = x(1), w = x(2), p = x(3), q = x(4), r = x(5);
  const double sin_phi = std::sin(x(9)), cos_phi = std::cos(x(9));
  const double sin_theta = std::sin(x(10)), cos_theta = std::cos(x(10));
  const double dr = in.rudder_rad, ds = in.stern_planes_rad;
  const double db = in.bow_plane_port_rad + in.bow_plane_starboard_rad;
  const double db_squares = in.bow_plane_port_rad * in.bow_plane_port_rad +
                            in.bow_plane_starboard_rad * in.bow_plane_starboard_rad;
  const double n = in.propeller_rad_s;
  const double e = epsilon(u, n);
  const double uu = u * u;
  const CrossFlow flow = hull().cross_flow(v, w, q, r, variant_.pitch_arm_of_mss);
  const double heavy = weight - buoyancy;
  const double arm_x = x_G * weight - x_B * buoyancy, arm_y = y_G * weight - y_B * buoyancy,
               arm_z = z_G * weight - z_B * buoyancy;
  constexpr double k_n = nps_auv_speed_per_revolution_m;

  Vector6 F;
  // (31), C18. The propeller as C_d0 (k_n^2 n|n| - u|u|), which needs no division and drags astern,
  // too (C28).
  F(0) = k4 * (X::pp * p * p + X::qq * q * q + X::rr * r * r + X::pr * p * r) +
         k3 * (X::wq * w * q + X::vp * v * p + X::vr * v * r +
               u * q * (X::q_ds * ds + X::q_db2 * db) + X::r_dr * u * r * dr) +
         k2 * (X::vv * v * v + X::ww * w * w + X::v_dr * u * v * dr +
               u * w * (X::w_ds * ds + X::w_db2 * db) +
               uu * (X::ds_ds * ds * ds + X::db_db2 * db_squares + X::dr_dr * dr * dr)) -
         heavy * sin_theta + k3 * X::q_ds_n * u * q * ds * e +
         k2 * (X::w_ds_n * u * w * ds + X::ds_ds_n * uu * ds * ds) * e +
         k2 * C_d0 * (k_n * k_n * n * std::abs(n) - u * std::abs(u)) -
         mass * (-v * r + w * q - x_G * (q * q + r * r) + y_G * p * q + z_G * p * r);
  // (32), C19
  F(1) = k4 * (Y::pq * p * q + Y::qr * q * r) +
         k3 * (Y::p * u * p + Y::r * u * r + Y::vq * v * q + Y::wp * w * p + Y::wr * w * r) +
         k2 * (Y::v * u * v + Y::vw * v * w + Y::dr * uu * dr) - flow.sway +
         heavy * cos_theta * sin_phi -
         mass * (u * r - w * p + x_G * p * q - y_G * (p * p + r * r) + z_G * q * r);
  // (33), C20-C22
  F(2) = k4 * (Z::pp * p * p + Z::pr * p * r + Z::rr * r * r) +
         k3 * (Z::q * u * q + Z::vp * v * p + Z::vr * v * r) +
         k2 * (Z::w * u * w + Z::vv * v * v + uu * (Z::ds * ds + Z::db2 * db)) - flow.heave +
         heavy * cos_theta * cos_phi + k3 * Z::q_n * u * q * e +
         k2 * (Z::w_n * u * w + Z::ds_n * uu * ds) * e -
         mass * (-u * q + v * p + x_G * p * r + y_G * q * r - z_G * (p * p + q * q));
  // (34), whose left-hand side is printed in (35): C23
  F(3) = k5 * (K::pq * p * q + K::qr * q * r) +
         k4 * (K::p * u * p + K::r * u * r + K::vq * v * q + K::wp * w * p + K::wr * w * r) +
         k3 * (K::v * u * v + K::vw * v * w + uu * K::db2 * db) + arm_y * cos_theta * cos_phi -
         arm_z * cos_theta * sin_phi + k4 * K::p_n * u * p * e + k3 * uu * K::prop -
         ((I_z - I_y) * q * r + I_xy * p * r - I_yz * (q * q - r * r) - I_xz * p * q +
          mass * (y_G * (-u * q + v * p) - z_G * (u * r - w * p)));
  // (35), whose left-hand side is printed in (34): C23-C25
  F(4) = k5 * (M::pp * p * p + M::pr * p * r + M::rr * r * r) +
         k4 * (M::q * u * q + M::vp * v * p + M::vr * v * r) +
         k3 * (M::w * u * w + M::vv * v * v + uu * (M::ds * ds + M::db2 * db)) +
         (variant_.pitch_arm_of_mss ? -flow.pitch_of_mss : flow.pitch) -
         arm_x * cos_theta * cos_phi - arm_z * sin_theta + k4 * M::q_n * u * q * e +
         k3 * (M::w_n * u * w + M::ds_n * uu * ds) * e -
         ((I_x - I_z) * p * r - I_xy * q * r + I_yz * p * q + I_xz * (p * p - r * r) -
          mass * (x_G * (-u * q + v * p) - z_G * (-v * r + w * q)));
  // (36), C26
  F(5) = k5 * (N::pq * p * q + N::qr * q * r) +
         k4 * (N::p * u * p + N::r * u * r + N::vq * v * q + N::wp * w * p + N::wr * w * r) +
         k3 * (N::v * u * v + N::vw * v * w + N::dr * uu * dr) - flow.yaw +
         arm_x * cos_theta * sin_phi + arm_y * sin_theta + k3 * uu * N::prop -
         ((I_y - I_x) * p * q - I_xy * (p * p - q * q) - I_yz * p * r + I_xz * q * r +
          mass * (x_G * (u * r - w * p) - y_G * (-v * r + w * q)));
  return F;
}

VehicleState NpsAuvModel::derivative(const VehicleState& state, const NpsAuvInputs& inputs,
                                     const Eigen::Vector2d& water,
                                     const Vector6& disturbance) const {
  // Velocities relative to the water feel the forces, and the water carries the body along: exact
  // for a uniform steady current. A body that crosses a shear at a speed u through the water is
  // carried over without inertia, which leaves out an acceleration of u grad(c).
  VehicleState rate;
  rate.head<6>().noalias() = inverse_mass_ * forces(state, inputs) + disturbance;
  rate.segment<3>(6) = KinematicModel::velocity(state.tail<3>(), state.head<3>());
  rate.segment<2>(6) += water;
  rate.tail<3>() = KinematicModel::euler_rates(state.tail<3>(), state);
  return rate;
}

BodyTangent NpsAuvModel::tangent(const VehicleState& state, const NpsAuvInputs& inputs) const {
  constexpr double step = 1e-6;
  const Vector6 here = forces(state, inputs);
  BodyTangent change;
  for (int k = 0; k < 8; ++k) {
    VehicleState beside = state;
    beside(k < 6 ? k : k + 3) += step;
    change.col(k) = (forces(beside, inputs) - here) / step;
  }
  return inverse_mass_ * change;
}

VehicleState NpsAuvModel::integrate(const VehicleState& state, const NpsAuvInputs& inputs,
                                    double step_s, const Eigen::Vector2d& water,
                                    const Vector6& disturbance) const {
  const auto rate = [&](const VehicleState& at) {
    return derivative(at, inputs, water, disturbance);
  };
  const VehicleState first = rate(state);
  const VehicleState second = rate(state + 0.5 * step_s * first);
  const VehicleState third = rate(state + 0.5 * step_s * second);
  const VehicleState fourth = rate(state + step_s * third);
  return state + step_s / 6.0 * (first + 2.0 * (second + third) + fourth);
}

}  // namespace shoal::scenarios
