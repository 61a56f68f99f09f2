"""Figures against time."""

import legends
import matplotlib.pyplot as plt
import numpy
import style

MANY = len(style.COLOURS)  # vehicles: more are shown by their range
INSTANTS = 240  # more of a range are a smear, even on two columns


def time_axes(run, rows=1):
    figure, axes = plt.subplots(rows, 1, sharex=True, squeeze=False)
    figure.set_figheight(figure.get_figheight() * (0.7 + 0.3 * rows))
    axes = axes[:, 0]
    hours = run.time_s[-1] > 3600
    axes[-1].set_xlabel("Time (h)" if hours else "Time (s)")
    for each in axes:
        each.margins(x=0)
    return figure, axes, (lambda seconds: seconds / 3600) if hours else (lambda seconds: seconds)


def from_start(*axes):
    """Once curves are drawn: limits that are set before hold for what was there, nothing."""
    for each in axes:
        each.set_xlim(left=0)


def from_zero(*axes):
    from_start(*axes)
    for each in axes:
        each.set_ylim(bottom=0)


def speeds(run):
    """Forward, through water: Barisic et al. 2011, figures 11 and 13."""
    speed = run.by_vehicle("speed")
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Speed (m/s)")
    if speed.shape[1] <= MANY:
        lines = [style.curve(axes, clock(run.time_s), own, vehicle, label=f"{vehicle + 1}")
                 for vehicle, own in enumerate(speed.T)]
        legends.legend_above(figure, lines, "Vehicle")
    else:
        envelope(axes, *coarse(clock(run.time_s), speed))
    from_start(axes)
    return figure


def coarse(time, values):
    """Instants, and the least, mean and greatest of all vehicles: of each instant, or of equal
    parts of the time if there are many."""
    parts = numpy.array_split(numpy.arange(len(time)), min(len(time), INSTANTS))
    values = numpy.ma.masked_invalid(values)  # of vehicles that were lost
    return (numpy.array([time[part].mean() for part in parts]),
            *(numpy.ma.filled(numpy.ma.stack([of(values[part]) for part in parts]), numpy.nan)
              for of in (numpy.ma.min, numpy.ma.mean, numpy.ma.max)))


def envelope(axes, x, least, mean, greatest):
    shade = axes.fill_between(x, least, greatest, facecolor=style.shade(0),
                              edgecolor=style.colour(0), linewidth=0.3, label="all vehicles")
    line = style.curve(axes, x, mean, label="mean")
    legends.legend_above(axes.figure, [shade, line])


def energy(run):
    """Mean of the vehicles and their range: Rypkema 2015, figures 5.12 ff."""
    mean, least, greatest = (run.series(f"energy_{of}_wh") for of in ("mean", "min", "max"))
    if mean is None:
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Energy (Wh)")
    envelope(axes, clock(mean[0]), least[1], mean[1], greatest[1])
    from_start(axes)
    return figure


def quality(run):
    """Formation quality: Rypkema 2015, figures 5.13 ff."""
    return of_series(run, "quality", "Formation quality (m)")


def efficiency(run):
    """How far the swarm comes for what it spends, so far: Rypkema 2015, figures 5.72 ff."""
    return of_series(run, "efficiency_m_per_wh", "Path / energy (m/Wh)")


def of_series(run, name, label):
    found = run.series(name)
    if found is None:
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel(label)
    style.curve(axes, clock(found[0]), found[1])
    from_zero(axes)
    return figure


def energy_by_distance(run):
    """Mean of the vehicles and their range, against the path of the swarm: Rypkema 2015, figures
    5.73 ff."""
    path = run.series("centroid_path_m")
    mean, least, greatest = (run.series(f"energy_{of}_wh") for of in ("mean", "min", "max"))
    if path is None or mean is None or len(path[1]) != len(mean[1]):
        return None
    figure, axes = plt.subplots()
    axes.set_xlabel("Path of the centroid (m)")
    axes.set_ylabel("Energy (Wh)")
    envelope(axes, path[1], least[1], mean[1], greatest[1])
    return figure


def thrust(run):
    """Shares of time and distance thrusting: Rypkema 2015, figures 5.76 ff."""
    shares = [(run.series(f"thrust_{of}_ratio_mean"), label)
              for of, label in (("time", "of the time"), ("distance", "of the distance"))]
    if any(found is None for found, _ in shares):
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Share thrusting")
    lines = [style.curve(axes, clock(found[0]), found[1], k, label=label)
             for k, (found, label) in enumerate(shares)]
    from_start(axes)
    axes.set_ylim(0, 1.02)
    legends.legend_above(figure, lines)
    return figure


def passage(run):
    """On the way: the error of the distances in the formation, the distance of the closest pair,
    and of the closest vehicle and obstacle."""
    shown = [(run.series(name), label) for name, label in
             (("cell_error_m", "Error (m)"), ("separation_m", "Pair (m)"),
              ("clearance_m", "Obstacle (m)"))]
    shown = [(found, label) for found, label in shown if found is not None]
    if not shown:
        return None
    figure, axes, clock = time_axes(run, len(shown))
    for each, (found, label) in zip(axes, shown):
        style.curve(each, clock(found[0]), found[1])
        each.set_ylabel(label)
    from_zero(*axes)
    figure.align_ylabels()
    return figure
