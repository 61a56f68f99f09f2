"""What a current is like in a window that drifts with it: the statistics that `shoal check` prints
of a current file, and the autocorrelations behind them, in numpy."""

import typing

import numpy


class Window(typing.NamedTuple):
    """A grid of points, and the instants at which it is looked at."""

    spacing_m: float = 100.0
    columns: int = 10
    rows: int = 13
    step_s: float = 100.0
    looks: int = 181

    @property
    def apart(self):
        """As many points are 300 m."""
        return round(300.0 / self.spacing_m)


def velocities(current, window, starts=((0.0, 0.0),)):
    """What the points of windows see that begin around `starts` and move with the mean over them.

    `current(x_m, y_m, time_s)` returns velocities of shape x_m.shape + (2,). Returns an array
    (start, look, row, column, component), and the way of each window, (start, component), in m.
    """
    x = window.spacing_m * (numpy.arange(window.columns) - 0.5 * (window.columns - 1))
    y = window.spacing_m * (numpy.arange(window.rows) - 0.5 * (window.rows - 1))
    x, y = numpy.meshgrid(x, y)
    starts = numpy.array(starts, dtype=float)
    places = starts.copy()
    seen = []
    for k in range(window.looks):
        px, py = places[:, 0, None, None], places[:, 1, None, None]
        seen.append(current(x + px, y + py, k * window.step_s))
        if k + 1 < window.looks:
            places += window.step_s * seen[-1].mean(axis=(1, 2))
    return numpy.stack(seen, axis=1), places - starts


def pairs(seen, apart):
    """Velocities at all points of a window that are `apart` steps from one another along x or y."""
    first = (seen[:, :, :-apart].reshape(-1, 2), seen[:, :-apart].reshape(-1, 2))
    second = (seen[:, :, apart:].reshape(-1, 2), seen[:, apart:].reshape(-1, 2))
    return numpy.concatenate(first), numpy.concatenate(second)


def shear(seen, window):
    a, b = pairs(seen, window.apart)
    return numpy.sqrt(((a - b) ** 2).sum(axis=-1).mean())


def autocorrelation_in_space(fluctuation):
    """At 0, 1 ... points' distance along x or y; 1 at 0."""
    products = [(fluctuation**2).sum(axis=-1).mean()]
    for apart in range(1, max(fluctuation.shape[1:3])):
        a, b = pairs(fluctuation, apart)
        products.append((a * b).sum(axis=-1).mean())
    return numpy.array(products) / products[0]


def autocorrelation_in_time(fluctuation):
    """At lags of 0, 1 ... looks; 1 at 0."""
    looks = len(fluctuation)
    products = [
        (fluctuation[: looks - k] * fluctuation[k:]).sum(axis=-1).mean() for k in range(looks)
    ]
    return numpy.array(products) / products[0]


def falls_to_1_e(correlation, step):
    level = numpy.exp(-1.0)
    k = int(numpy.argmax(correlation <= level))
    if k == 0:
        return None
    return step * (k - 1 + (correlation[k - 1] - level) / (correlation[k - 1] - correlation[k]))


def statistics(current):
    """By the names of scenarios/currents/current_statistics.hpp, where nothing is missing."""
    window = Window()
    (seen,), (drift,) = velocities(current, window)
    mean = seen.mean(axis=(0, 1, 2))
    fluctuation = seen - mean
    variance = (fluctuation**2).mean(axis=(0, 1, 2))
    return {
        "mean_u_m_s": mean[0],
        "mean_v_m_s": mean[1],
        "drift_m": numpy.hypot(*drift),
        "variance_u_m2_s2": variance[0],
        "variance_v_m2_s2": variance[1],
        "shear_300m_m_s": shear(seen, window),
        "decorrelation_length_m": falls_to_1_e(
            autocorrelation_in_space(fluctuation), window.spacing_m
        ),
        "decorrelation_time_s": falls_to_1_e(autocorrelation_in_time(fluctuation), window.step_s),
    }


def read(path):
    """The current of a file on axes in metres, linear between its nodes and times."""
    import netCDF4
    from scipy.interpolate import RegularGridInterpolator

    with netCDF4.Dataset(path) as file:
        axes = [numpy.asarray(file[name][:], dtype=float) for name in ("time", "y", "x")]
        values = numpy.stack([file[name][:].filled(numpy.nan) for name in ("u", "v")], axis=-1)
    linear = RegularGridInterpolator(axes, values)
    return lambda x, y, t: linear(numpy.stack([numpy.full(x.shape, t), y, x], axis=-1))
