"""Figures of what a run was made of: they ask the Python package, and are left out where it was not
built."""

import math

import fitting
import legends
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy
import over_ground
import style

ARROWS = 16  # along the longer side
KEY_IN = 0.25

try:
    import shoal
except ImportError:
    shoal = None


def behaviour_with_potential(run):
    """(behaviour, its options, its pair potential), if it has one that is known here."""
    kind = run.scenario["behaviour"]["kind"]
    options = run.scenario["behaviour"].get(kind, {})
    if shoal is None or "separation_m" not in options:
        return None
    law = options.get("potential", {})
    try:
        return kind, options, shoal.potential(law["kind"], **law.get(law["kind"], {}))
    except (KeyError, shoal.InputError):  # a function or a plug-in of the program that ran it
        return None


def potential(run):
    """The pair potential, its slope and its curvature: Rypkema 2015, figure 3.6 (which draws the
    slope below)."""
    found = behaviour_with_potential(run)
    if found is None:
        return None
    _, options, law = found
    s = options["separation_m"]
    r = numpy.linspace(0.35 * s, 2.2 * s, 600)
    figure, axes = plt.subplots(3, 1, sharex=True)
    figure.set_figheight(1.6 * figure.get_figheight())
    labels = ("Value", "Slope (1/m)", "Curvature (1/m²)")
    for ax, values, label in zip(axes, law.derivatives(r, s), labels):
        ax.plot(r, values, color=style.COLOURS[0])
        ax.axvline(s, color=style.GROUND, linewidth=0.8, zorder=0)
        ax.set_ylabel(label)
    axes[1].axhline(0, color=style.GROUND, linewidth=0.8, zorder=0)
    axes[-1].set_xlabel("Distance (m)")
    figure.align_ylabels()
    return figure


def cost_surface(run):
    """The cost that the first vehicle meets at the end of the run, by where it would go, and where
    its target says: Rypkema 2015, figure 3.7."""
    found = behaviour_with_potential(run)
    if found is None:
        return None
    kind, options, _ = found
    x, y = run.by_vehicle("x")[-1], run.by_vehicle("y")[-1]
    left = numpy.flatnonzero(numpy.isfinite(x))
    if len(left) < 2:
        return None
    own, others = left[0], left[1:]
    neighbours = numpy.column_stack([x[others] - x[own], y[others] - y[own]])
    plan = shoal.Plan([[0, 0], [options["separation_m"], 0]])
    posed = shoal.posed(kind, options, neighbours, plan)
    if not posed:
        return None
    problem = posed[0]
    reach = 1.3 * options["separation_m"]
    axis = numpy.linspace(-reach, reach, 121)
    surface = numpy.array([[problem.evaluate([east, north])[0] for east in axis] for north in axis])
    # What rises without bound next to a vehicle would hide all else.
    finite = surface[numpy.isfinite(surface)]
    top = numpy.percentile(finite, 85)
    figure, axes = plt.subplots()
    levels = matplotlib.ticker.MaxNLocator(14).tick_values(finite.min(), top)
    shown = axes.contourf(axis, axis, numpy.minimum(surface, top), levels=levels, cmap="cividis")
    figure.colorbar(shown, ax=axes, label="Cost", shrink=0.8)
    near = numpy.abs(neighbours).max(axis=1) <= reach
    target = shoal.solve(problem).x
    # White for the dark middle of the surface, edged with black for the paper behind a legend.
    edged = {"linestyle": "none", "markeredgecolor": "black", "markeredgewidth": 0.7,
             "clip_on": False}
    marks = [*axes.plot(*neighbours[near].T, "o", color=style.COLOURS[1], markersize=4.5,
                        label="neighbours", **edged),
             *axes.plot(0, 0, "X", color="white", markersize=6, label="vehicle", **edged),
             *axes.plot(*target, "*", color="white", markersize=9, label="minimum", **edged)]
    axes.set_aspect("equal")
    axes.set_xlabel("East of the vehicle (m)")
    axes.set_ylabel("North of the vehicle (m)")
    legends.legend_above(figure, marks)
    return figure


def filter_lag(run):
    """What the ping filter makes of a neighbour's range from the first vehicle, with noise drawn
    anew: Rypkema 2015, figure 3.5. The neighbour is the one that is never far."""
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    if shoal is None or x.shape[1] < 2:
        return None
    farthest = numpy.hypot(x[:, 1:] - x[:, :1], y[:, 1:] - y[:, :1]).max(axis=0)
    if numpy.isnan(farthest).all():  # each pair has lost a vehicle
        return None
    pair = (0, 1 + int(numpy.nanargmin(farthest)))
    ping, last = run.scenario["ping"], run.time_s[-1]
    noise = numpy.random.default_rng(1)
    tracks = shoal.PingFilter(run.scenario["ping_filter"])
    times, measured, filtered, actual = [], [], [], []
    for time in numpy.arange(ping["first_s"] + ping["period_s"], last, ping["period_s"]):
        place = [numpy.array([numpy.interp(time, run.time_s, x[:, i]),
                              numpy.interp(time, run.time_s, y[:, i])]) for i in pair]
        offset = place[1] - place[0]
        distance = math.hypot(*offset)
        if not distance <= ping["range_m"]:
            continue
        heard = max(0.0, distance + noise.normal(0, ping["range_sd_m"]))
        error = math.radians(noise.normal(0, ping["bearing_sd_deg"]))
        bearing = math.atan2(offset[1], offset[0]) + error
        tracks.receive(shoal.Ping(time_s=time, range_m=heard, bearing_rad=bearing, slot=1),
                       place[0])
        times.append(time)
        actual.append(distance)
        measured.append(heard)
        filtered.append(math.hypot(*tracks.neighbours(time, place[0])[0]))
    if len(times) < 2:
        return None
    figure, axes = plt.subplots()
    clock = numpy.array(times) / (3600 if last > 3600 else 1)
    marks = [*axes.plot(clock, measured, ".", color=style.COLOURS[5], markersize=3,
                        label="measured"),
             style.curve(axes, clock, actual, color="black", marker="", label="actual"),
             style.curve(axes, clock, filtered, 1, marker="", label="filtered")]
    axes.set_xlabel("Time (h)" if last > 3600 else "Time (s)")
    axes.set_ylabel("Range of a neighbour (m)")
    axes.margins(x=0)
    legends.legend_above(figure, marks)
    return figure


def current(run):
    """The current where the swarm went, in the middle of its mission: Rypkema 2015, figure 4.3."""
    if shoal is None:
        return None
    x, y = run.by_vehicle("x"), run.by_vehicle("y")
    figure, axes, _ = over_ground.plane(run, x, y)
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    step = max(east - west, north - south) / ARROWS
    east, north = numpy.meshgrid(numpy.arange(west + step / 2, east, step),
                                 numpy.arange(south + step / 2, north, step))
    u, v = shoal.current(run.scenario, float(run.time_s[-1]) / 2, east, north)
    if not numpy.isfinite(u).any() or not numpy.nanmax(numpy.hypot(u, v)) > 0:
        plt.close(figure)
        return None
    fastest = float(numpy.nanmax(numpy.hypot(u, v)))
    # The longest arrow is a step long, about its place: none leaves the axes or meets another.
    arrows = axes.quiver(east, north, u, v, color=style.COLOURS[0], pivot="middle", angles="xy",
                         scale_units="xy", scale=fastest / step, width=0.004)
    shown = float(f"{fastest:.1g}")
    fitting.heighten(figure, strip=KEY_IN)
    axes.quiverkey(arrows, 0.5, 1 - 0.5 * KEY_IN / figure.get_figheight(), shown, f"{shown:g} m/s",
                   labelpos="E", coordinates="figure")
    return figure
