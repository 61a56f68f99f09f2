"""Progress curves of solvers."""

import legends
import names
import panels
import profiles
import style

LEAST = 1e-10  # of the descent: what is left below it is rounding


def progress(rows):
    """The share of the descent that is left after so many evaluations or seconds: the median over
    the problems, and the middle half of them."""
    kinds = list(dict.fromkeys((row["family"], row["measure"]) for row in rows))
    solvers = profiles.few_solvers(rows)
    across = panels.across(len(kinds)) if style.wide() else 1
    figure, axes = panels.grid(len(kinds), across, panels.panel_height(max(across, 2)))
    handles = {}
    for ax, (family, measure) in zip(axes, kinds):
        end = last_descent(row for row in rows if (row["family"], row["measure"]) == (family, measure))
        for k, solver in enumerate(solvers):
            own = [[float(row[name]) for name in ("effort", "left", "left_low", "left_high")]
                   for row in rows
                   if (row["family"], row["measure"], row["solver"]) == (family, measure, solver)
                   and float(row["effort"]) <= end]
            if not own:
                continue
            effort, left, low, high = zip(*own)
            shown = [[max(each, LEAST) for each in numbers] for numbers in (left, low, high)]
            handles[solver] = style.curve(ax, effort, shown[0], k, marker="",
                                          drawstyle="steps-post", label=names.plain(solver))
            style.band(ax, effort, shown[1], shown[2], k, step="post")
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_ylim(LEAST, 2)
        ax.set_title(names.sentence(names.plain(family)))
        ax.set_ylabel("Share of the descent left")
        ax.set_xlabel(names.sentence(names.plain(measure)))
    legends.legend_above(figure, [handles[solver] for solver in solvers if solver in handles])
    return figure


def last_descent(rows):
    """Twice the effort up to which some solver has more than rounding left in three of four problems."""
    return 2 * max((float(row["effort"]) for row in rows if float(row["left_high"]) > LEAST), default=1.0)
