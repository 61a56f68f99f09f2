"""tests/data/potential_field.csv: forces of an obstacle, a waypoint and a vertex on a vehicle.

Barisic, Vukic and Miskovic (2011), eq. 6-29, with the corrections C3-C17 of
notebooks/corrections.md; distances to obstacles by eq. 46-49 with C40-C43. Each force is per unit
mass, in m/s2, by itself: no sum is formed.

Given: an obstacle (kind, cx, cy, a, b in m, psi in rad; a is the radius of a circle, or with b half
the size of a rectangle), the vehicle at x, y (m) with velocity vx, vy (m/s), a waypoint wx, wy (m).
Computed: distance d (m) and outward normal nx, ny of the obstacle, its stator and rotor forces with
the rotor's alignment r_i and sense sigma, the waypoint's force wp, and that of a vertex which is
where the obstacle's centre is.
"""

import numpy

from reference import Reference

# The default gains.
K_O = 1.0  # m2/s2; C4
A_PLUS_M = 18.0
A_R_M = 24.0
A_0 = 0.05  # m/s2
D_0_M = 60.0  # A_0 / A_p; C6
A_C = 0.05  # m/s2
D_C_M = 10.0
TIE = 1e-3  # C14


def unit(vector):
    return vector / numpy.linalg.norm(vector)


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def sign(number):
    return 1.0 if number >= 0.0 else -1.0


def proximity(kind, centre, half, psi, place):
    """Distance to an obstacle from outside, and its outward normal."""
    if kind == "circle":  # eq. 46, 47
        away = place - centre
        return numpy.linalg.norm(away) - half[0], unit(away)
    # Eq. 48, 49: from the nearest point of the rectangle, in its own frame (C40-C43).
    axes = numpy.array([[numpy.cos(psi), -numpy.sin(psi)], [numpy.sin(psi), numpy.cos(psi)]])
    local = axes.T @ (place - centre)
    away = local - numpy.clip(local, -half, half)
    return numpy.linalg.norm(away), axes @ unit(away)


def push(strength_m, d):
    """Eq. 7 and 26: the size of p_o' (C3, C4; no case is so near that it is limited)."""
    return K_O * strength_m / d**2 * numpy.exp(strength_m / d)


def waypoint(towards):
    """Eq. 10 with C5, C6, C11."""
    distance = numpy.linalg.norm(towards)
    return min(A_0 / D_0_M * distance, A_0) * towards / distance


def vertex(towards):
    """Eq. 12 with C7, C10."""
    return A_C / D_C_M * numpy.exp(0.5 * (1.0 - towards @ towards / D_C_M**2)) * towards


def turn(centre, target, n, velocity):
    """Eq. 28, 29 with C13, C14: alignment and sense of the rotor."""
    m = unit(centre - target)
    alignment = m @ n
    if alignment < 0.0:
        return alignment, 0.0
    return alignment, sign(cross(m, n) if alignment <= 1.0 - TIE else cross(n, velocity))


def results(rows):
    for row in rows:
        def pair(x, y):
            return numpy.array([float(row[x]), float(row[y])])

        place, centre, target = pair("x", "y"), pair("cx", "cy"), pair("wx", "wy")
        d, n = proximity(row["kind"], centre, pair("a", "b"), float(row["psi"]), place)
        alignment, sense = turn(centre, target, n, pair("vx", "vy"))
        stator = push(A_PLUS_M, d) * n  # eq. 18 with C9
        rotor = push(A_R_M, d) * sense * numpy.array([-n[1], n[0]])  # eq. 25-27 with C15
        found = {"d": d, "nx": n[0], "ny": n[1], "r_i": alignment, "sigma": sense}
        for name, force in (("stator", stator), ("rotor", rotor), ("wp", waypoint(target - place)),
                            ("vertex_at_cxcy", vertex(centre - place))):
            found |= {f"{name}_x": force[0], f"{name}_y": force[1]}
        yield found


REFERENCES = [Reference("potential_field.csv", results, digits=17, tolerance=1e-14)]
