"""Performance profiles of solvers."""

import legends
import names
import panels
import style

MOST = len(style.COLOURS)


def profiles(rows):
    """Dolan and Moré 2002: the share of the problems that a solver solves at no more than so many
    times the price of the best."""
    kinds = list(dict.fromkeys((row["family"], row["measure"]) for row in rows))
    solvers = few_solvers(rows)
    across = panels.across(len(kinds)) if style.wide() else 1
    figure, axes = panels.grid(len(kinds), across, panels.panel_height(max(across, 2)))
    handles = {}
    for ax, (family, measure) in zip(axes, kinds):
        curves = {solver: [(float(row["factor"]), float(row["share"])) for row in rows
                           if (row["family"], row["measure"], row["solver"])
                           == (family, measure, solver)] for solver in solvers}
        end = 2 * max(rise(steps) for steps in curves.values())
        for k, (solver, steps) in enumerate(curves.items()):
            shown = [step for step in steps if step[0] <= end]
            if shown:
                handles[solver] = style.curve(ax, *zip(*shown), k, marker="",
                                              drawstyle="steps-post", label=names.plain(solver))
        ax.set_xscale("log", base=2)
        ax.set_ylim(0, 1.02)
        ax.set_title(names.sentence(names.plain(family)))
        ax.set_ylabel("Share of problems")
        ax.set_xlabel(f"Times the {names.plain(measure)} of the best")
    legends.legend_above(figure, [handles[solver] for solver in solvers])
    return figure


def few_solvers(rows):
    solvers = list(dict.fromkeys(row["solver"] for row in rows))
    if len(solvers) > MOST:
        raise panels.TooMuch(f"there are {len(solvers)} solvers, and a figure shows at most "
                             f"{MOST}; choose some with shoal solve --solvers")
    return solvers


def rise(steps):
    """The factor from which on a curve is level; 1 of none."""
    last = steps[-1][1] if steps else 0.0
    return next((factor for factor, share in steps if share == last), 1.0)
