"""Figures of the plane: where vehicles went."""

import legends
import matplotlib.patches
import matplotlib.pyplot as plt
import numpy
import style

BESIDE_IN, BELOW_IN = 0.6, 0.5  # labels of axes
MANY = 50  # vehicles whose marks would hide their paths


def plane(run, x, y):
    """Axes in metres that hold these places, with obstacles and waypoint; the mark of that, if
    there is one."""
    figure, axes = plt.subplots()
    axes.set_xlabel("East (m)")
    axes.set_ylabel("North (m)")
    shown = [numpy.column_stack([numpy.ravel(x), numpy.ravel(y)])]
    marks = []
    if run.waypoint:
        marks = axes.plot(*run.waypoint, marker="*", color="black", markersize=7, linestyle="none",
                          label="waypoint", zorder=4)
        shown.append([run.waypoint])
    for outline in run.obstacles:
        axes.add_patch(matplotlib.patches.Polygon(outline, facecolor=style.GROUND, edgecolor="none",
                                                  zorder=1))
        shown.append(outline)
    show(figure, axes, numpy.concatenate(shown))
    return figure, axes, marks


def show(figure, axes, places):
    """Limits that hold all places, in axes of their shape: a metre north is as long as one east."""
    low, high = numpy.nanmin(places, axis=0), numpy.nanmax(places, axis=0)
    margin = 0.04 * (high - low) + 5.0
    low, high = low - margin, high + margin
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    width = figure.get_figwidth()
    height = (width - BESIDE_IN) * (high[1] - low[1]) / (high[0] - low[0])
    most = 0.7 * width if style.wide() else width
    figure.set_figheight(min(max(height, 0.3 * width), most) + BELOW_IN)


def trajectories(run):
    """Crosses where vehicles start, circles where they end: Rypkema 2015, chapter 5; Barisic et al.
    2011, figures 10 and 12."""
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    figure, axes, marks = plane(run, x, y)
    for vehicle in range(x.shape[1]):
        axes.plot(x[:, vehicle], y[:, vehicle], color=style.colour(vehicle), linewidth=0.7,
                  zorder=2)
    size = 4 if x.shape[1] <= MANY else 2
    marks += axes.plot(x[0], y[0], "x", color="black", markersize=size, markeredgewidth=0.2 * size,
                       label="start", zorder=3)
    east, north, lost = run.ends()
    for some, mark, label in ((~lost, "o", "end"), (lost, "s", "lost")):
        if some.any():
            marks += axes.plot(east[some], north[some], mark, color=style.COLOURS[1],
                               markersize=size, fillstyle="none", markeredgewidth=0.2 * size,
                               label=label, zorder=3)
    few = len(style.COLOURS)
    title = f"colours repeat after {few} vehicles" if x.shape[1] > few else None
    legends.legend_above(figure, marks, title)
    return figure


def basin(run):
    """Which starts arrive: Barisic et al. 2011, figure 2. Of swarms that go to a waypoint and are
    large enough for a picture."""
    if not run.waypoint or run.by_vehicle("x").shape[1] < MANY:
        return None
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    arrived = run.arrived()
    figure, axes, marks = plane(run, *(numpy.append(each[0], each[:, ~arrived]) for each in (x, y)))
    for some, mark, colour, label in ((arrived, ".", style.COLOURS[5], "arrives"),
                                      (~arrived, "s", style.COLOURS[1], "never arrives")):
        if some.any():
            marks += axes.plot(x[0, some], y[0, some], mark, color=colour, markersize=3,
                               label=label, zorder=3)
    for vehicle in numpy.flatnonzero(~arrived):
        axes.plot(x[:, vehicle], y[:, vehicle], color=style.COLOURS[1], linewidth=0.4, zorder=2)
    legends.legend_above(figure, marks)
    return figure
