"""Legends above what they explain."""

import fitting
import matplotlib
import names
from long_form import UNNAMED


def legend_above(figure, handles, title=None):
    """A legend that hides nothing, in as few rows as its figure is wide enough for."""
    width = figure.get_figwidth() - 2 * fitting.GAP_PT / 72
    renderer = figure.canvas.get_renderer()
    size = matplotlib.rcParams["legend.fontsize"]
    for handle in handles:
        handle.set_label(fitting.wrapped(handle.get_label(), width - 0.5, size))
    title = title and fitting.wrapped(title, width, size)
    for rows in range(1, len(handles) + 1):
        legend = figure.legend(handles=handles, title=title, ncol=-(-len(handles) // rows),
                               loc="upper center", borderaxespad=0.3)
        box = legend.get_tightbbox(renderer)
        if box.width / figure.dpi <= width:
            break
        if rows < len(handles):
            legend.remove()
    fitting.heighten(figure, strip=box.height / figure.dpi + 2 * fitting.GAP_PT / 72)
    return legend


def explain(figure, handles, keys, wording, notes):
    """Which marks stand for which levels, if any do, and what else is to be said; levels of one
    factor stand below its name."""
    title = None
    if handles and all(len(key) == 1 and key[0][0] != UNNAMED for key in keys):
        title = wording.axis(keys[0][0][0])
        for handle, key in zip(handles, keys):
            handle.set_label(names.plain(key[0][1]) or "-")
    if handles or notes:
        legend_above(figure, [*handles, *notes], title)
