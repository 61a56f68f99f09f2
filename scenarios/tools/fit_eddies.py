"""fit_eddies.py START.eddies REFERENCE.nc > FITTED.eddies

Moves the eddies of START until their current has the statistics of REFERENCE (on axes in metres)
in a window that drifts with it: means, variances, shear, and autocorrelations in space and time.
Windows that begin a little beside the origin count, too, so that a formation that goes its own way
meets the same water. What stands before [mean] is START's.
"""

import sys
import tomllib

import numpy
from scipy.optimize import least_squares

import drifting_window

# Of an eddy: name, what it may be, and how far it moves as easily as the others.
PARAMETERS = [
    ("x_m", -4000, 4000, 300),
    ("y_m", -4000, 5000, 300),
    ("radius_m", 400, 1000, 150),
    ("speed_m_s", -0.12, 0.12, 0.02),
    ("drift_u_m_s", -0.1, 0.1, 0.02),
    ("drift_v_m_s", -0.1, 0.1, 0.02),
    ("swing", 0, 0.9, 0.15),
    ("period_s", 4000, 40000, 6000),
    ("phase", -10, 10, 1.0),
]
NAMES = [name for name, *_ in PARAMETERS]
SCALE = numpy.array([scale for *_, scale in PARAMETERS], dtype=float)
MEAN_SCALE_M_S = 0.01
STARTS_M = [(0, 0), (-200, -200), (200, -200), (-200, 200), (200, 200)]
# Coarser than what is tested, to be quick.
WINDOW = drifting_window.Window(spacing_m=150, columns=7, rows=9, step_s=300, looks=61)
LAGS = [2, 4, 7, 10, 13, 17, 20, 27, 33]
BESIDE = 0.2  # weight of the windows that begin beside the origin
STAY = 0.1  # weight of a parameter's move by its scale


def eddies_at(mean, eddies):
    """The current of scenarios/tools/make_current.cpp."""
    x0, y0, radius, speed, drift_u, drift_v, swing, period, phase = eddies.T

    def current(x, y, t):
        dx = (x[..., None] - x0 - drift_u * t) / radius
        dy = (y[..., None] - y0 - drift_v * t) / radius
        strength = speed * (1 + swing * numpy.sin(2 * numpy.pi * t / period + phase))
        strength = strength * numpy.exp(0.5 * (1 - dx**2 - dy**2))
        turning = numpy.stack([-(strength * dy).sum(-1), (strength * dx).sum(-1)], axis=-1)
        return mean + turning

    return current


def profile(seen):
    """The numbers to be fitted, and how far each may be off."""
    mean = seen.mean(axis=(0, 1, 2))
    fluctuation = seen - mean
    numbers = [
        (mean, 0.0006),
        ((fluctuation**2).mean(axis=(0, 1, 2)) ** 0.5, 0.0004),
        ([drifting_window.shear(seen, WINDOW)], 0.0004),
        (seen.mean(axis=(1, 2)).std(axis=0), 0.001),
        (drifting_window.autocorrelation_in_space(fluctuation)[1:], 0.02),
        (drifting_window.autocorrelation_in_time(fluctuation)[LAGS], 0.04),
    ]
    return (
        numpy.concatenate([n for n, _ in numbers]),
        numpy.concatenate([numpy.full(len(n), tolerance) for n, tolerance in numbers]),
    )


def fitted(eddies, reference):
    (seen,), _ = drifting_window.velocities(reference, WINDOW)
    wanted, tolerance = profile(seen)
    mean = wanted[:2]  # from which the flow beside the eddies moves away

    def unpacked(moves):
        return mean + moves[:2] * MEAN_SCALE_M_S, eddies + moves[2:].reshape(eddies.shape) * SCALE

    def residuals(moves):
        current = eddies_at(*unpacked(moves))
        misses = [STAY * moves]
        windows, _ = drifting_window.velocities(current, WINDOW, STARTS_M)
        for place, seen in enumerate(windows):
            got, _ = profile(seen)
            misses.append((got - wanted) / tolerance * (BESIDE if place else 1.0))
        return numpy.concatenate(misses)

    low = numpy.array([least for _, least, _, _ in PARAMETERS])
    high = numpy.array([most for _, _, most, _ in PARAMETERS])
    inside = numpy.clip(eddies, low + 0.01 * SCALE, high - 0.01 * SCALE)
    bounds = [
        numpy.concatenate([[mean_moves] * 2, ((limit - eddies) / SCALE).ravel()])
        for mean_moves, limit in ((-3, low), (3, high))
    ]
    start = numpy.concatenate([[0, 0], ((inside - eddies) / SCALE).ravel()])
    best = least_squares(residuals, start, bounds=bounds, max_nfev=60)
    print(f"sum of squares: {2 * best.cost:.4g}, {best.message}", file=sys.stderr)
    return unpacked(best.x)


def main():
    start, reference = sys.argv[1:]
    with open(start, encoding="utf-8") as file:
        text = file.read()
    source = tomllib.loads(text)
    eddies = numpy.array([[eddy[name] for name in NAMES] for eddy in source["eddy"]], dtype=float)
    mean, eddies = fitted(eddies, drifting_window.read(reference))
    print(text[: text.index("[mean]")], end="")
    print(f"[mean]\nu_m_s = {mean[0]:.4f}\nv_m_s = {mean[1]:.4f}")
    for eddy in eddies:
        print("\n[[eddy]]")
        for name, value in zip(NAMES, eddy):
            print(f"{name} = {value:.0f}" if abs(value) >= 10 else f"{name} = {value:.4f}")


if __name__ == "__main__":
    main()
