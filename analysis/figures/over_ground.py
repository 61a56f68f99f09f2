"""Figures of the plane: where vehicles went."""

import math

import matplotlib.patches
import matplotlib.pyplot as plt
import numpy
import style


def plane(run, x, y):
    """Axes in metres that hold these places, with obstacles and way-point."""
    figure, axes = plt.subplots()
    axes.set_xlabel("East (m)")
    axes.set_ylabel("North (m)")
    axes.set_aspect("equal")
    shown = [numpy.ravel(x), numpy.ravel(y)]
    if run.waypoint:
        axes.plot(*run.waypoint, marker="*", color="black", markersize=7, linestyle="none",
                  label="way-point", zorder=4)
        shown = [numpy.append(s, w) for s, w in zip(shown, run.waypoint)]
    for kind, options in run.obstacles:
        axes.add_patch(shape(kind, options))
        reach = options.get("radius_m") or max(options["half_length_m"], options["half_width_m"])
        shown = [numpy.append(s, [options[c] - reach, options[c] + reach])
                 for s, c in zip(shown, ("x_m", "y_m"))]
    for limits, values in ((axes.set_xlim, shown[0]), (axes.set_ylim, shown[1])):
        margin = 0.04 * (values.max() - values.min()) + 5.0
        limits(values.min() - margin, values.max() + margin)
    return figure, axes


def shape(kind, options):
    looks = {"facecolor": style.GROUND, "edgecolor": "none", "zorder": 1}
    middle = (options["x_m"], options["y_m"])
    if kind == "circle":
        return matplotlib.patches.Circle(middle, options["radius_m"], **looks)
    angle = 90.0 - options["heading_deg"]  # counter-clockwise from east
    length, width = 2 * options["half_length_m"], 2 * options["half_width_m"]
    if kind == "ellipse":
        return matplotlib.patches.Ellipse(middle, length, width, angle=angle, **looks)
    turn = math.radians(angle)
    corner = (middle[0] - 0.5 * (length * math.cos(turn) - width * math.sin(turn)),
              middle[1] - 0.5 * (length * math.sin(turn) + width * math.cos(turn)))
    return matplotlib.patches.Rectangle(corner, length, width, angle=angle, **looks)



def trajectories(run):
    """Crosses where vehicles start, circles where they end: Rypkema 2015, chapter 5; Barisic et al.
    2011, figures 10 and 12."""
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    figure, axes = plane(run, x, y)
    for vehicle in range(x.shape[1]):
        axes.plot(x[:, vehicle], y[:, vehicle], color=style.colour(vehicle), linewidth=0.7,
                  zorder=2)
    axes.plot(x[0], y[0], "x", color="black", markersize=4, markeredgewidth=0.8, label="start",
              zorder=3)
    axes.plot(x[-1], y[-1], "o", color=style.COLOURS[1], markersize=4, fillstyle="none",
              markeredgewidth=0.8, label="end", zorder=3)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    return figure


def basin(run):
    """Which starts arrive: Barisic et al. 2011, figure 2. Of swarms that go to a way-point and are
    large enough for a picture."""
    if not run.waypoint or run.by_vehicle("x").shape[1] < 50:
        return None
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    arrived = run.arrived()
    figure, axes = plane(run, x[0], y[0])
    for some, mark, colour, label in ((arrived, ".", style.COLOURS[5], "arrives"),
                                      (~arrived, "s", style.COLOURS[1], "never arrives")):
        axes.plot(x[0, some], y[0, some], mark, color=colour, markersize=3, label=label, zorder=3)
    for vehicle in numpy.flatnonzero(~arrived):
        axes.plot(x[:, vehicle], y[:, vehicle], color=style.COLOURS[1], linewidth=0.4, zorder=2)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    return figure
