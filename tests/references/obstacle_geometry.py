"""tests/data/obstacle_geometry.csv: distances to circles, rectangles and ellipses.

Barisic, Vukic and Miskovic (2011), sec. 5.1, by what a distance is rather than by eq. 46-62: the
nearest point of the edge is searched, so that the corrections C40-C46 of notebooks/corrections.md
are tested, too. Of an ellipse many points are tried, and all that are nearer than their neighbours
are refined by Newton's method. All in 40 digits.

Given: shape, tag (why the case is there), centre cx, cy (m), a_or_r and b (radius, or half sizes, m),
angle psi (rad), place px, py (m).
Computed: signed_distance (m; negative inside), outward normal nx, ny, and the nearest point of the
edge closest_x, closest_y (m). unique is 0 where the nearest point or the normal is not unique: nan.
"""

import decimal
from decimal import Decimal

import numpy

from reference import Reference

DIGITS = 17
decimal.getcontext().prec = 40
TINY = Decimal("1e-30")


def number(text):
    """Exactly the double that the text stands for."""
    return Decimal(float(text))


def cosine_and_sine(angle):
    """By the power series of exp(i angle)."""
    sums, term, k = [Decimal(1), Decimal(0)], Decimal(1), 0
    while abs(term) > Decimal("1e-45"):
        k += 1
        term *= angle / k
        sums[k % 2] += -term if k % 4 >= 2 else term
    return sums


def norm(vector):
    return (vector[0] ** 2 + vector[1] ** 2).sqrt()


def unit(vector):
    return vector / norm(vector)


def clamp(value, limit):
    return min(max(value, -limit), limit)


# Of each shape in its own frame: points of the edge with the outward normal there (None at a
# corner), among them all that are nearest; and whether a place is inside. Vectors are arrays of
# Decimals.

def on_circle(place, r, _):
    return [(r * unit(place), unit(place))], norm(place) < r


def on_rectangle(place, a, b):
    x, y = place
    found = []
    for sign in (1, -1):
        for foot, normal in (((sign * a, clamp(y, b)), (Decimal(sign), Decimal(0))),
                             ((clamp(x, a), sign * b), (Decimal(0), Decimal(sign)))):
            at_corner = abs(foot[0]) == a and abs(foot[1]) == b
            found.append((numpy.array(foot), None if at_corner else numpy.array(normal)))
    return found, abs(x) < a and abs(y) < b


def on_ellipse(place, a, b):
    half = numpy.array([a, b])
    angles = numpy.linspace(0.0, 2.0 * numpy.pi, 1440, endpoint=False)
    tried = numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=-1)
    distances = numpy.linalg.norm(tried * half.astype(float) - place.astype(float), axis=-1)
    nearer = (distances <= numpy.roll(distances, 1)) & (distances <= numpy.roll(distances, -1))
    found = []
    for direction in tried[nearer]:
        direction = refined(numpy.array([Decimal(float(c)) for c in direction]), place, half)
        found.append((half * direction, unit(direction / half)))  # eq. 52
    return found, ((place / half) ** 2).sum() < 1


def refined(direction, place, half):
    """Newton's method for the cosine and sine of the angle at which half * direction is nearest."""
    for _ in range(200):
        tangent = numpy.array([-direction[1], direction[0]])
        away = half * direction - place
        slope = (away * half * tangent).sum()
        curvature = ((half * tangent) ** 2).sum() - (away * half * direction).sum()
        if abs(slope) <= TINY:
            break
        direction = unit(direction - slope / curvature * tangent)
    return direction


EDGES = {"circle": on_circle, "rectangle": on_rectangle, "ellipse": on_ellipse}


def nearest(edge, inside, place):
    """Signed distance, normal and nearest point; None for what is not unique."""
    distances = [norm(place - point) for point, _ in edge]
    least = min(distances)
    best = [each for each, distance in zip(edge, distances) if distance - least < TINY]
    point, normal = best[0]
    signed = -least if inside else least
    if any(norm(other - point) > TINY for other, _ in best):
        return signed, None, None
    return signed, normal if least < TINY else (place - point) / signed, point


def shown(value):
    """With 17 digits and always a point, as in 4.0 or -1.25e-7."""
    rounded = Decimal(f"{value:.{DIGITS - 1}e}").normalize()
    if abs(rounded) < TINY:
        return "0.0"
    if -5 <= rounded.adjusted() < DIGITS:
        shortest = f"{rounded:f}"
        return shortest if "." in shortest else shortest + ".0"
    mantissa, exponent = f"{rounded:e}".split("e")
    return f"{mantissa if '.' in mantissa else mantissa + '.0'}e{exponent}"


def results(rows):
    for row in rows:
        cx, cy, a, b, psi, px, py = (
            number(row[name]) for name in ("cx", "cy", "a_or_r", "b", "psi", "px", "py"))
        cosine, sine = cosine_and_sine(psi)
        axes = numpy.array([[cosine, -sine], [sine, cosine]])
        centre = numpy.array([cx, cy])
        place = axes.T @ (numpy.array([px, py]) - centre)
        distance, normal, point = nearest(*EDGES[row["shape"]](place, a, b), place)
        nx, ny = ["nan"] * 2 if normal is None else map(shown, axes @ normal)
        x, y = ["nan"] * 2 if point is None else map(shown, centre + axes @ point)
        yield {"signed_distance": shown(distance), "nx": nx, "ny": ny, "closest_x": x,
               "closest_y": y, "unique": "0" if normal is None else "1"}


# What is stored of the sides of rectangles is off by some 1e-18 m, as a search for the least of a
# function in 35 digits leaves it; all else agrees in all digits.
REFERENCES = [Reference("obstacle_geometry.csv", results, digits=DIGITS, tolerance=2e-17)]
