"""How all figures look, and how they are written."""

import contextlib
import io
import os

import matplotlib.colors
import matplotlib.pyplot
import numpy

# Okabe and Ito 2008, told apart by all readers; their yellow and light blue are darkened until thin
# lines stand out from white paper (WCAG 2.1: a contrast of 3 to 1).
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#BF8500", "#2F96CF", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]
DASHES = ["-", (0, (5, 1.5)), (0, (1.2, 1)), (0, (5, 1.2, 1.2, 1.2))]
FEW = 30  # points: so many are marked one by one
GROUND = "#B0B0B0"  # obstacles and grids
COLUMN_IN = 8.4 / 2.54
GAP_IN = 0.6 / 2.54

RULES = {
    "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 7, "legend.fontsize": 7,
    "legend.title_fontsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.linewidth": 0.6,
    "lines.linewidth": 0.9, "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "legend.columnspacing": 1.2, "legend.handletextpad": 0.5,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "axes.formatter.useoffset": False,  # a tick says its number, and no difference from another
    "pdf.fonttype": 42, "svg.fonttype": "path",  # fonts are in the file
    "svg.hashsalt": "shoal",
    "figure.constrained_layout.use": True,
}


@contextlib.contextmanager
def page(columns):
    """Figures made inside are as wide as so many columns."""
    width = columns * COLUMN_IN + (columns - 1) * GAP_IN
    height = 0.7 * width if columns == 1 else 0.45 * width
    with matplotlib.rc_context({**RULES, "figure.figsize": (width, height)}):
        yield
    matplotlib.pyplot.close("all")


def wide():
    """Whether this page is more than a column wide."""
    return matplotlib.rcParams["figure.figsize"][0] > 1.5 * COLUMN_IN


def colour(k):
    return COLOURS[k % len(COLOURS)]


def shade(k):
    """Of a band that curves are seen through."""
    return matplotlib.colors.to_rgba(colour(k), 0.16)


def curve(axes, x, y, k=0, **look):
    """The k-th curve of an axes. Of few points each is marked; of many, those without neighbours,
    of which nothing would be seen otherwise. Marks shrink from curve to curve, so that one does not
    hide another where both are equal."""
    x, y = numpy.asarray(x, dtype=float), numpy.asarray(y, dtype=float)
    known = numpy.isfinite(y)
    alone = known & ~numpy.append(False, known[:-1]) & ~numpy.append(known[1:], False)
    marks = {}
    if known.sum() < FEW:
        marks = {"marker": MARKERS[k % len(MARKERS)], "markersize": 3.8 - 0.3 * (k % len(MARKERS))}
    elif alone.any():
        marks = {"marker": "o", "markersize": 1.5, "markevery": numpy.flatnonzero(alone).tolist()}
    look = {"color": colour(k), "linestyle": DASHES[k % len(DASHES)], "clip_on": False,
            **marks, **look}
    return axes.plot(x, y, **look)[0]


def opened(line, some):
    """Opens some marks of a curve."""
    if not any(some):  # a layout would find room for a curve without points
        return
    x, y = line.get_xdata()[some], line.get_ydata()[some]
    line.axes.plot(x, y, linestyle="none", color=line.get_color(), markerfacecolor="white",
                   marker=MARKERS[COLOURS.index(line.get_color())], markersize=3.2, clip_on=False,
                   zorder=line.get_zorder() + 0.1)


def trials(axes, x, y, k):
    """What is behind the k-th mark or curve of an axes."""
    axes.plot(x, y, "o", color=colour(k), markersize=2.2, alpha=0.3, markeredgewidth=0)


def band(axes, x, low, high, k=0, **look):
    axes.fill_between(x, low, high, facecolor=shade(k), edgecolor="none", **look)


# In every file, so that figures that are no longer drawn can be told from files of the user.
CREATOR = "shoal figures"


def remove_others(folder, made):
    """Removes the figures of earlier calls that the last one did not draw."""
    for file in (*folder.glob("*.pdf"), *folder.glob("*.svg")):
        if file in made:
            continue
        text = file.read_text("latin-1")
        if f"({CREATOR})" in text or f">{CREATOR}<" in text:
            file.unlink()


def save(figure, folder, name):
    """As PDF and SVG, each there when it is complete. The same figure gives the same bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    made = []
    for ending, metadata in (("pdf", {"CreationDate": None, "Creator": CREATOR}),
                             ("svg", {"Date": None, "Creator": [CREATOR]})):
        file = folder / f"{name}.{ending}"
        part = folder / f".{name}.{ending}.part"
        whole = io.BytesIO()  # Matplotlib does not survive a full disk
        figure.savefig(whole, format=ending, metadata=metadata)
        try:
            part.write_bytes(whole.getbuffer())
            os.replace(part, file)
        finally:
            part.unlink(missing_ok=True)
        made.append(file)
    return made
