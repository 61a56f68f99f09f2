"""tests/data/force_clamp.csv: forces made admissible for a vehicle.

Barisic, Vukic and Miskovic (2011), eq. 81-88 and Table 3, with the corrections C56-C62 of
notebooks/corrections.md. In a complex number the real part is along the heading and the imaginary
part across it, to starboard; s = f + u/T is the velocity after one period, over the period (m/s2).

Given: force f_par, f_perp (m/s2), speed u_prev (m/s) and turn rate r_prev (rad/s) at the sample,
period T (s), and the envelope u_max (m/s), du_max (m/s2), r_max (rad/s), dr_max (rad/s2); u_min = 0.
Computed: speed command u_cmd (m/s), turn dpsi_cmd (rad), and the force that is left (m/s2).
"""

import cmath
import math

from reference import Reference

GIVEN = ["f_par", "f_perp", "u_prev", "r_prev", "T", "u_max", "du_max", "r_max", "dr_max"]


def clamp(value, low, high):
    return min(max(value, low), high)


def admissible(f, u, r, T, u_max, du_max, r_max, dr_max):
    """Size and angle of the velocity over the period that is used in place of f + u/T."""
    # Eq. 85 and 86: what the speed may become; C60.
    fastest = clamp(u / T + du_max, 0.0, u_max / T)
    slowest = clamp(u / T - du_max, 0.0, u_max / T)
    # Eq. 83, 84, 87 and 88: how far the vehicle may turn; C57-C59.
    port = clamp(T * r - T**2 * dr_max, -T * r_max, T * r_max)
    starboard = clamp(T * r + T**2 * dr_max, -T * r_max, T * r_max)

    s = f + u / T
    if not slowest <= abs(s) <= fastest or s.real < 0.0:
        along, across = s.real, s.imag
        if f.real > 0.0:  # accelerating: the turn first
            across = clamp(across, -fastest, fastest)
            along = math.sqrt(fastest**2 - across**2)
        else:  # braking: the speed first; C60, C61
            along = clamp(along, max(0.0, u / T - du_max), fastest)
            room = math.sqrt(fastest**2 - along**2)
            across = clamp(across, -room, room)
        s = complex(along, across)

    size, angle = cmath.polar(s)  # C56
    limit = clamp(angle, port, starboard)
    if limit != angle:
        if f.real > 0.0:  # the nearest point of the ray at the limit; C62
            size = (s * cmath.rect(1.0, -limit)).real
        else:  # the speed along the heading stays
            size = s.real / math.cos(limit)
    return clamp(size, slowest, fastest), limit


def results(rows):
    for row in rows:
        f_par, f_perp, u, r, T, *envelope = (float(row[name]) for name in GIVEN)
        size, angle = admissible(complex(f_par, f_perp), u, r, T, *envelope)
        force = cmath.rect(size, angle) - u / T
        yield {"u_cmd": T * size, "dpsi_cmd": angle, "f_par_out": force.real,
               "f_perp_out": force.imag}


# The inputs have 15 digits, and f is a small difference of velocities over the period.
REFERENCES = [Reference("force_clamp.csv", results, digits=15, tolerance=1e-12)]
