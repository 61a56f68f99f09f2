"""How all figures look, and how they are written."""

import contextlib
import os

import matplotlib.pyplot

# Okabe and Ito 2008: told apart by everybody. Vehicles, behaviours and bounds in this order.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
GROUND = "#B0B0B0"  # obstacles and grids
COLUMN_IN = 8.4 / 2.54
GAP_IN = 0.6 / 2.54

RULES = {
    "font.size": 8, "axes.labelsize": 8, "legend.fontsize": 7, "xtick.labelsize": 7,
    "ytick.labelsize": 7, "axes.linewidth": 0.6, "lines.linewidth": 0.9,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "pdf.fonttype": 42, "svg.fonttype": "path",  # fonts are in the file
    "svg.hashsalt": "shoal",
    "figure.constrained_layout.use": True,
}


@contextlib.contextmanager
def page(columns):
    """Figures made inside are as wide as so many columns."""
    width = columns * COLUMN_IN + (columns - 1) * GAP_IN
    with matplotlib.rc_context({**RULES, "figure.figsize": (width, 0.7 * width)}):
        yield
    matplotlib.pyplot.close("all")


def colour(vehicle):
    return COLOURS[vehicle % len(COLOURS)]


def save(figure, folder, name):
    """As PDF and SVG, each there when it is complete. The same figure gives the same bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    made = []
    for ending, metadata in (("pdf", {"CreationDate": None}), ("svg", {"Date": None})):
        file = folder / f"{name}.{ending}"
        part = folder / f".{name}.{ending}.part"
        try:
            figure.savefig(part, format=ending, metadata=metadata)
            os.replace(part, file)
        finally:
            part.unlink(missing_ok=True)
        made.append(file)
    return made
