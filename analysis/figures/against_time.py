"""Figures against time."""

import matplotlib.pyplot as plt
import style

MANY = 8  # vehicles: more are shown by their range


def time_axes(run, rows=1):
    figure, axes = plt.subplots(rows, 1, sharex=True, squeeze=False)
    figure.set_figheight(figure.get_figheight() * (0.7 + 0.3 * rows))
    axes = axes[:, 0]
    hours = run.time_s[-1] > 3600
    axes[-1].set_xlabel("Time (h)" if hours else "Time (s)")
    axes[-1].set_xlim(0, run.time_s[-1] / (3600 if hours else 1))
    return figure, axes, (lambda seconds: seconds / 3600) if hours else (lambda seconds: seconds)


def speeds(run):
    """Forward, through water: Barisic et al. 2011, figures 11 and 13."""
    speed = run.by_vehicle("speed")
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Speed (m/s)")
    if speed.shape[1] <= MANY:
        for vehicle in range(speed.shape[1]):
            axes.plot(clock(run.time_s), speed[:, vehicle], color=style.colour(vehicle),
                      label=f"{vehicle + 1}")
        axes.legend(title="vehicle", loc="best", ncol=2)
    else:
        envelope(axes, clock(run.time_s), speed.min(axis=1), speed.mean(axis=1), speed.max(axis=1))
        axes.legend(loc="best")
    return figure


def envelope(axes, time, least, mean, greatest):
    axes.fill_between(time, least, greatest, color=style.COLOURS[0], alpha=0.2, linewidth=0,
                      label="all vehicles")
    axes.plot(time, mean, color=style.COLOURS[0], label="mean")


def energy(run):
    """Mean of the vehicles and their range: Rypkema 2015, figures 5.12 ff."""
    mean, least, greatest = (run.series(f"energy_{of}_wh") for of in ("mean", "min", "max"))
    if mean is None:
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Energy (Wh)")
    envelope(axes, clock(mean[0]), least[1], mean[1], greatest[1])
    axes.legend(loc="best")
    return figure


def quality(run):
    """Formation quality: Rypkema 2015, figures 5.13 ff."""
    found = run.series("quality")
    if found is None:
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Formation quality (m)")
    axes.set_ylim(0, None)
    axes.plot(clock(found[0]), found[1], color=style.COLOURS[0])
    axes.set_ylim(bottom=0)
    return figure


def efficiency(run):
    """How far the swarm comes for what it spends, so far: Rypkema 2015, figures 5.72 ff."""
    found = run.series("efficiency_m_per_wh")
    if found is None:
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Path / energy (m/Wh)")
    axes.plot(clock(found[0]), found[1], color=style.COLOURS[0])
    axes.set_ylim(bottom=0)
    return figure


def energy_by_distance(run):
    """Mean of the vehicles and their range, against the path of the swarm: Rypkema 2015, figures 5.73
    ff."""
    path = run.series("centroid_path_m")
    mean, least, greatest = (run.series(f"energy_{of}_wh") for of in ("mean", "min", "max"))
    if path is None or mean is None or len(path[1]) != len(mean[1]):
        return None
    figure, axes = plt.subplots()
    axes.set_xlabel("Path of the centroid (m)")
    axes.set_ylabel("Energy (Wh)")
    envelope(axes, path[1], least[1], mean[1], greatest[1])
    axes.legend(loc="best")
    return figure


def thrust(run):
    """Shares of time and distance thrusting: Rypkema 2015, figures 5.76 ff."""
    shares = [(run.series(f"thrust_{of}_ratio_mean"), label)
              for of, label in (("time", "of the time"), ("distance", "of the distance"))]
    if any(found is None for found, _ in shares):
        return None
    figure, (axes,), clock = time_axes(run)
    axes.set_ylabel("Share thrusting")
    axes.set_ylim(0, 1.02)
    for found, label in shares:
        axes.plot(clock(found[0]), found[1], label=label)
    axes.legend(loc="best")
    return figure


def passage(run):
    """On the way: the error of the distances in the formation, the distance of the closest pair, and
    of the closest vehicle and obstacle."""
    shown = [(run.series(name), label) for name, label in
             (("cell_error_m", "Error (m)"), ("separation_m", "Pair (m)"),
              ("clearance_m", "Obstacle (m)"))]
    shown = [(found, label) for found, label in shown if found is not None]
    if not shown:
        return None
    figure, axes, clock = time_axes(run, len(shown))
    for each, (found, label) in zip(axes, shown):
        each.plot(clock(found[0]), found[1], color=style.COLOURS[0])
        each.set_ylabel(label)
        each.set_ylim(bottom=0)
    figure.align_ylabels()
    return figure
