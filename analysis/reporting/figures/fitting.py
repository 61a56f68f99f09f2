"""Room for texts: labels in lines that fit, ticks that keep apart, rows as high as their names."""

import functools
import textwrap

import matplotlib.ticker
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

GAP_PT = 3.0
FIRM = "\N{NO-BREAK SPACE}"
ROUNDS = 5


def width_in(text, size):
    """Of the widest line, in inches."""
    return max((line_width_in(line, size) for line in text.splitlines()), default=0.0)


@functools.lru_cache(maxsize=None)
def line_width_in(line, size):
    font = FontProperties(size=size)
    return text_to_path.get_text_width_height_descent(line, font, ismath=False)[0] / 72


def wrapped(text, inches, size):
    """In lines of at most that width, broken at commas if their parts fit, and within a word only
    where it alone is wider."""
    text = " ".join(text.split())
    if width_in(text, size) <= inches:
        return text
    text = ", ".join(part.replace(" ", FIRM) if width_in(part + ",", size) <= inches else part
                     for part in text.split(", "))

    def lines(characters):
        return "\n".join(textwrap.wrap(text, characters, break_on_hyphens=False))

    fewest, most = 1, len(text)  # characters of a line: so many fit, and so many do not
    while most - fewest > 1:
        middle = (fewest + most) // 2
        fits = width_in(lines(middle), size) <= inches
        fewest, most = (middle, most) if fits else (fewest, middle)
    return lines(fewest).replace(FIRM, " ")


def heighten(figure, axes=0.0, strip=0.0):
    """By inches that are room for its axes, and by those of a strip above, which axes leave
    alone."""
    layout = figure.get_layout_engine()
    below = figure.get_figheight() * layout.get()["rect"][3] + axes
    height = figure.get_figheight() + axes + strip
    figure.set_figheight(height)
    layout.set(rect=(0, 0, 1, below / height))


def labels_of(axes):
    """(label, the inches it may take, the power of ten that ticks leave to it) of an axes as it
    stands."""
    box = axes.get_window_extent()
    across, down = box.width / axes.figure.dpi, box.height / axes.figure.dpi
    return [(axes.xaxis.label, across, power_of(axes.xaxis)),
            (axes.yaxis.label, down, power_of(axes.yaxis)), (axes.title, across, "")]


def power_of(axis):
    """Matplotlib would write it where labels stand."""
    axis.offsetText.set_visible(False)
    return axis.get_offset_text().get_text()


def with_power(text, power):
    """`Energy (1e6 Wh)`, `Share (1e-6)`."""
    if not power or not text:
        return text
    name, _, unit = text.rpartition("(")
    return f"{name}({power} {unit}" if text.endswith(")") else f"{text} ({power})"


def fit(figure):
    """Wraps the labels of axes, takes ticks of numbers away, and makes room for names of rows,
    until no text needs the room of another: each change moves what the next is measured by."""
    whole = {}
    for _ in range(ROUNDS):
        figure.draw_without_rendering()
        changed = False
        for axes in figure.axes:
            for label, inches, power in labels_of(axes):
                text = with_power(whole.setdefault(label, label.get_text()), power)
                lines = wrapped(text, inches, label.get_size())
                changed |= lines != label.get_text()
                label.set_text(lines)
            changed |= thinned(axes.xaxis) or thinned(axes.yaxis)
        missing = max(missing_height(axes) for axes in figure.axes)
        if missing > 0:
            heighten(figure, missing)
        elif not changed:
            break
    return figure


def boxes_of(axis):
    """Of the labels of its ticks, with half of the gap that is to be between them."""
    axis.get_ticklabels()  # brings them up to date
    renderer = axis.figure.canvas.get_renderer()
    low, high = sorted(axis.get_view_interval())
    shown = [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
    return [label.get_window_extent(renderer).padded(0.5 * GAP_PT * axis.figure.dpi / 72)
            for label in shown if label.get_visible() and label.get_text()]


def crowded(axis):
    boxes = boxes_of(axis)
    return any(one.overlaps(other) for one, other in zip(boxes, boxes[1:]))


def has_names(axis):
    """Rather than numbers, of which some can be left out."""
    return isinstance(axis.get_major_locator(), matplotlib.ticker.FixedLocator)


def thinned(axis):
    """Takes ticks of an axis of numbers away while they are crowded; says whether it did."""
    if has_names(axis) or not crowded(axis):
        return False
    for intervals in range(len(axis.get_majorticklocs()), 0, -1):
        axis.set_major_locator(fewer(axis, intervals))
        if not crowded(axis):
            break
    return True


def fewer(axis, intervals):
    if axis.get_scale() == "linear":
        return matplotlib.ticker.MaxNLocator(intervals, steps=[1, 2, 2.5, 5, 10])
    return matplotlib.ticker.LogLocator(axis.get_transform().base, numticks=intervals + 1)


def missing_height(axes):
    """Inches, and some to spare, that a figure lacks for the names of rows in axes."""
    if not has_names(axes.yaxis):
        return 0.0
    boxes = sorted(boxes_of(axes.yaxis), key=lambda box: box.y0)
    share = max((0.5 * (one.height + other.height) / (0.5 * (other.y0 + other.y1 - one.y0 - one.y1))
                 for one, other in zip(boxes, boxes[1:])), default=0.0)
    if share <= 1:
        return 0.0
    rows = axes.get_subplotspec().get_gridspec().nrows
    return rows * (share - 0.99) * axes.get_window_extent().height / axes.figure.dpi
