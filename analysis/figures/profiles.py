"""Performance profiles of solvers."""

import legends
import names
import panels
import style


def profiles(rows):
    """Dolan and Moré 2002: the share of the problems that a solver solves at no more than so many
    times the price of the best."""
    kinds = list(dict.fromkeys((row["family"], row["measure"]) for row in rows))
    solvers = list(dict.fromkeys(row["solver"] for row in rows))
    across = panels.across(len(kinds))
    figure, axes = panels.grid(len(kinds), across, panels.panel_height(across))
    handles = {}
    for ax, (family, measure) in zip(axes, kinds):
        for k, solver in enumerate(solvers):
            steps = [(float(row["factor"]), float(row["share"])) for row in rows
                     if (row["family"], row["measure"], row["solver"]) == (family, measure, solver)]
            if steps:
                handles[solver] = style.curve(ax, *zip(*steps), k, marker="",
                                              drawstyle="steps-post", label=names.plain(solver))
        ax.set_xscale("log", base=2)
        ax.set_ylim(0, 1.02)
        ax.set_title(names.sentence(names.plain(family)))
        ax.set_ylabel("Share of problems")
        ax.set_xlabel(f"Times the {names.plain(measure)} of the best")
    legends.legend_above(figure, [handles[solver] for solver in solvers])
    return figure
