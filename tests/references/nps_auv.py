"""tests/data/nps_auv_derivatives.csv and nps_auv_trajectories.csv: the vehicle model.

Barisic, Vukic and Miskovic (2011), eq. 31-40 and Table 1, with the corrections C1 and C18-C35 of
notebooks/corrections.md. Of what the chapter writes out per axis, only the terms with coefficients
are here as printed; the motion of the rigid body (Newton and Euler), weight and buoyancy are vectors.

State: u v w (m/s), p q r (rad/s), x y z (m), phi theta psi (rad); z points down. Inputs: delta_r
delta_s delta_bp delta_bs (rad), n (rad/s). The derivatives file has with each state and inputs its
rates, the forces F_X F_Y F_Z (N) and moments F_K F_M F_N (N m), which are all that acts but the
terms with accelerations, and epsilon of eq. 39. The trajectories are of Runge and Kutta's method of
fourth order in steps of 0.05 s; from a row to the next the inputs are those of the former.
"""

import itertools

import numpy

from reference import Reference

STATE = ["u", "v", "w", "p", "q", "r", "x", "y", "z", "phi", "theta", "psi"]
INPUTS = ["delta_r", "delta_s", "delta_bp", "delta_bs", "n_rad_s"]
RATES = ["d" + name for name in STATE]
FORCES = ["F_X", "F_Y", "F_Z", "F_K", "F_M", "F_N"]

# Table 1.
WEIGHT_N = BUOYANCY_N = 53.4e3
LENGTH_M = 5.3
MASS_KG = 5454.54
DENSITY = 1000.0  # kg/m3
I_X, I_Y, I_Z = 2038.0, 13587.0, 13587.0  # kg m2; C32
I_XY = I_YZ = I_XZ = -13.58
CENTRE_OF_GRAVITY_M = numpy.array([0.0, 0.0, 0.061])
CENTRE_OF_BUOYANCY_M = numpy.zeros(3)

# Added mass: what stands before accelerations in eq. 31-36. C34, C35.
X_du = -7.6e-3
Y_dv, Y_dp, Y_dr = -5.5e-2, 1.2e-4, 1.2e-3
Z_dw, Z_dq = -2.4e-1, -6.8e-3
K_dv, K_dp, K_dr = 1.2e-4, -1.0e-3, -3.4e-5
M_dw, M_dq = -6.8e-3, -1.7e-2
N_dv, N_dp, N_dr = 1.2e-3, -3.4e-5, -3.4e-3

# Eq. 38-40 and 42.
C_D0 = 0.00385
K_N_M = 1.832 / 52.359  # C28
LEAST_SPEED_M_S = 0.05  # C31
C_T1 = 0.008 * (LENGTH_M / 0.3048) ** 2 / 2.0  # the length in feet; C30
# The hull in the cross flow; C27.
HEIGHT_M = BREADTH_M = 0.53
C_DY, C_DZ = 0.5, 0.6
PANELS = 20

STEP_S = 0.05

K2, K3, K4, K5 = (0.5 * DENSITY * LENGTH_M**k for k in (2, 3, 4, 5))


def skew(a):
    """skew(a) @ b is the cross product of a and b."""
    return numpy.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def mass_matrix():
    """Rigid body and added mass."""
    arm = MASS_KG * skew(CENTRE_OF_GRAVITY_M)
    body = numpy.block([[MASS_KG * numpy.eye(3), -arm], [arm, INERTIA]])
    added = numpy.zeros((6, 6))
    added[0, 0] = K3 * X_du
    added[1, 1], added[1, 3], added[1, 5] = K3 * Y_dv, K4 * Y_dp, K4 * Y_dr
    added[2, 2], added[2, 4] = K3 * Z_dw, K4 * Z_dq
    added[3, 1], added[3, 3], added[3, 5] = K4 * K_dv, K5 * K_dp, K5 * K_dr
    added[4, 2], added[4, 4] = K4 * M_dw, K5 * M_dq
    added[5, 1], added[5, 3], added[5, 5] = K4 * N_dv, K5 * N_dp, K5 * N_dr
    return body - added


INERTIA = numpy.array([[I_X, -I_XY, -I_XZ], [-I_XY, I_Y, -I_YZ], [-I_XZ, -I_YZ, I_Z]])
MASS = mass_matrix()


def centrifugal(v, omega):
    """What motion with constant v and omega takes of forces and moments; C23."""
    turning = skew(omega)
    acceleration = turning @ v
    force = MASS_KG * (acceleration + turning @ turning @ CENTRE_OF_GRAVITY_M)
    moment = turning @ INERTIA @ omega + MASS_KG * skew(CENTRE_OF_GRAVITY_M) @ acceleration
    return numpy.concatenate([force, moment])


def orientation(phi, theta, psi):
    """From the vehicle's frame to the world's."""
    def turned(angle, i, j):
        R = numpy.eye(3)
        R[i, i] = R[j, j] = numpy.cos(angle)
        R[j, i], R[i, j] = numpy.sin(angle), -numpy.sin(angle)
        return R

    return turned(psi, 0, 1) @ turned(theta, 2, 0) @ turned(phi, 1, 2)


def restoring(down):
    """Weight and buoyancy, with the direction of the first in the vehicle's frame."""
    weight, buoyancy = WEIGHT_N * down, -BUOYANCY_N * down
    moment = skew(CENTRE_OF_GRAVITY_M) @ weight + skew(CENTRE_OF_BUOYANCY_M) @ buoyancy
    return numpy.concatenate([weight + buoyancy, moment])


def cross_flow(v, w, q, r):
    """The integrals of eq. 32, 33, 35 and 36 with C19-C21, C24, C26, C27, by Simpson's rule."""
    x, step = numpy.linspace(-0.5 * LENGTH_M, 0.5 * LENGTH_M, PANELS + 1, retstep=True)
    share = numpy.full(PANELS + 1, 2.0)
    share[1::2], share[0], share[-1] = 4.0, 1.0, 1.0
    across, down = v + x * r, w - x * q
    speed = numpy.hypot(across, down)  # eq. 37
    drag = C_DY * HEIGHT_M * across**2 + C_DZ * BREADTH_M * down**2
    drag = -0.5 * DENSITY * step / 3.0 * share * drag / numpy.where(speed > 0.0, speed, 1.0)
    Y, Z = drag * across, drag * down
    return numpy.array([0.0, Y.sum(), Z.sum(), 0.0, -(x * Z).sum(), (x * Y).sum()])


def epsilon(u, n):
    """Eq. 39, 40 with C29-C31."""
    eta = K_N_M * n / max(abs(u), LEAST_SPEED_M_S)
    race = (numpy.sqrt(1.0 + C_T1 * eta**2) - 1.0) / (numpy.sqrt(1.0 + C_T1) - 1.0)
    return -1.0 + numpy.sign(n) * (1.0 if u >= 0.0 else -1.0) * race


def hydrodynamic(u, v, w, p, q, r, dr, ds, dbp, dbs, n):
    """Eq. 31-36: what is neither of the body, nor of its weight, nor of the cross flow."""
    e = epsilon(u, n)
    db = dbp + dbs  # the coefficients of "delta_b/2" are of one plane
    X = (K4 * (7.0e-3 * p * p - 1.5e-2 * q * q + 4.0e-3 * r * r + 7.5e-4 * p * r)
         + K3 * (-2.0e-1 * w * q - 3.0e-3 * v * p + 2.0e-2 * v * r
                 + u * q * (2.5e-2 * ds - 1.3e-3 * db) - 1.0e-3 * u * r * dr
                 + 2.0e-3 * u * q * ds * e)  # C18
         + K2 * (5.3e-2 * v * v + 1.7e-1 * w * w + 1.7e-3 * u * v * dr
                 + u * w * (4.6e-2 * ds + 0.5e-2 * db)
                 + u * u * (-1.0e-2 * ds**2 - 4.0e-3 * (dbp**2 + dbs**2) - 1.0e-2 * dr**2)
                 + (3.5e-3 * u * w * ds - 1.6e-3 * u * u * ds**2) * e
                 + C_D0 * (K_N_M**2 * n * abs(n) - u * abs(u))))  # C28
    Y = (K4 * (4.0e-3 * p * q - 6.5e-3 * q * r)
         + K3 * (3.0e-3 * u * p + 3.0e-2 * u * r + 2.4e-2 * v * q + 2.3e-1 * w * p
                 - 1.9e-2 * w * r)  # C19
         + K2 * (-1.0e-1 * u * v + 6.8e-2 * v * w + 2.7e-2 * u * u * dr))
    Z = (K4 * (1.3e-4 * p * p + 6.7e-3 * p * r - 7.4e-3 * r * r)
         + K3 * (-1.4e-1 * u * q - 4.8e-2 * v * p + 4.5e-2 * v * r  # C33
                 - 2.9e-3 * u * q * e)
         + K2 * (-3.0e-1 * u * w - 6.8e-2 * v * v + u * u * (-7.3e-2 * ds - 1.3e-2 * db)
                 + (-5.1e-3 * u * w - 1.0e-2 * u * u * ds) * e))  # C22
    K = (K5 * (-6.9e-5 * p * q + 1.7e-2 * q * r)
         + K4 * (-1.1e-2 * u * p - 8.4e-4 * u * r - 5.1e-3 * v * q - 1.3e-4 * w * p
                 + 1.4e-2 * w * r - 5.7e-4 * u * p * e)
         + K3 * (3.1e-3 * u * v - 1.9e-1 * v * w))  # K_prop and that of the bow planes are 0
    M = (K5 * (5.3e-5 * p * p + 5.0e-3 * p * r + 2.9e-3 * r * r)
         + K4 * (-6.8e-2 * u * q + 1.2e-3 * v * p + 1.7e-2 * v * r - 1.6e-3 * u * q * e)  # C25
         + K3 * (1.0e-1 * u * w - 2.6e-2 * v * v + u * u * (-4.1e-2 * ds + 3.5e-3 * db)
                 + (-2.9e-3 * u * w - 5.2e-3 * u * u * ds) * e))
    N = (K5 * (-2.1e-2 * p * q + 2.7e-3 * q * r)
         + K4 * (-8.4e-4 * u * p - 1.6e-2 * u * r - 1.0e-2 * v * q - 1.7e-2 * w * p
                 + 7.4e-3 * w * r)
         + K3 * (-7.4e-3 * u * v - 2.7e-2 * v * w - 1.3e-2 * u * u * dr))  # N_prop is 0
    return numpy.array([X, Y, Z, K, M, N])


def forces(state, inputs):
    u, v, w, p, q, r = velocity = state[:6]
    down = orientation(*state[9:])[2]
    return (hydrodynamic(*velocity, *inputs) + cross_flow(v, w, q, r) + restoring(down)
            - centrifugal(velocity[:3], velocity[3:]))


def derivative(state, inputs):
    phi, theta, _ = state[9:]
    # The turn rates in the vehicle's frame that rates of phi, theta and psi of 1 rad/s give.
    turning = numpy.array([[1.0, 0.0, -numpy.sin(theta)],
                           [0.0, numpy.cos(phi), numpy.sin(phi) * numpy.cos(theta)],
                           [0.0, -numpy.sin(phi), numpy.cos(phi) * numpy.cos(theta)]])
    return numpy.concatenate([numpy.linalg.solve(MASS, forces(state, inputs)),
                              orientation(*state[9:]) @ state[:3],
                              numpy.linalg.solve(turning, state[3:6])])


def runge_kutta(state, inputs):
    a = derivative(state, inputs)
    b = derivative(state + 0.5 * STEP_S * a, inputs)
    c = derivative(state + 0.5 * STEP_S * b, inputs)
    d = derivative(state + STEP_S * c, inputs)
    return state + STEP_S / 6.0 * (a + 2.0 * b + 2.0 * c + d)


def numbers(row, names):
    return numpy.array([float(row[name]) for name in names])


def derivatives(rows):
    for row in rows:
        state, inputs = numbers(row, STATE), numbers(row, INPUTS)
        yield (dict(zip(RATES, derivative(state, inputs)))
               | dict(zip(FORCES, forces(state, inputs))) | {"epsilon": epsilon(state[0], inputs[-1])})


def trajectories(rows):
    for before, row in itertools.pairwise([None, *rows]):
        if float(row["t"]) == 0.0:
            state = numbers(row, STATE)
            yield {}
        else:
            inputs = numbers(before, INPUTS)
            for _ in range(round((float(row["t"]) - float(before["t"])) / STEP_S)):
                state = runge_kutta(state, inputs)
            yield dict(zip(STATE, state))


REFERENCES = [Reference("nps_auv_derivatives.csv", derivatives, digits=17, tolerance=1e-14),
              Reference("nps_auv_trajectories.csv", trajectories, digits=15, tolerance=1e-13)]
