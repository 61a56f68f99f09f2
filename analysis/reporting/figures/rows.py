"""Named rows: means with their intervals as points, indices as bars."""

import itertools
import math

import fitting
import gaps
import legends
import matplotlib.pyplot as plt
import names
import panels
import style
from long_form import by_measure

MOST = 60  # rows of one panel: a page of them
LONG = 12  # rows that are worth the room of a second panel beside them
LINE_IN = 0.117
MARK_IN = 0.055
BELOW_IN = 0.45  # ticks and their axis' name


def panel_grid(measures, rows, series):
    """Axes for these measures, below or beside one another, with named rows that have room for their
    names and for so many marks each."""
    width = plt.rcParams["figure.figsize"][0]
    beside = 3 if style.wide() else 2 if len(rows) > LONG else 1
    across = min(len(measures), beside)
    size = plt.rcParams["ytick.labelsize"]
    texts = [fitting.wrapped(row, (0.38 if style.wide() else 0.42) * width, size) for row in rows]
    lines = max(text.count("\n") + 1 for text in texts)
    height = len(rows) * max(lines * LINE_IN, series * MARK_IN) + 0.05
    figure, axes = panels.grid(len(measures), across, max(height, 0.5) + BELOW_IN, sharey=True)
    for k, ax in enumerate(axes):
        ax.set_yticks(range(len(texts)), texts)
        ax.set_ylim(len(texts) - 0.5, -0.5)
        ax.tick_params(labelleft=k % across == 0)
    return figure, axes


def require_few(rows, name):
    if rows > MOST:
        raise panels.TooMuch(f"{name} has {rows} rows, and a figure shows at most {MOST}; select "
                             f"some with where in the request of {name}, or pool factors")


def apart(numbers, columns):
    """The factors whose levels are marks within a row: those of columns, and of long tables as many
    more as can be told apart, so that rows are few."""
    factors = list(numbers[0].levels)
    across = tuple(factor for factor in factors if factor in columns)
    if len(keys(numbers, across)) > len(style.COLOURS):
        across = ()
    if len(keys(numbers, others(factors, across))) <= LONG:
        return across
    choices = [across]
    for count in range(1, len(factors) - len(across)):
        for more in itertools.combinations(others(factors, across), count):
            some = tuple(factor for factor in factors if factor in {*across, *more})
            if len(keys(numbers, some)) <= len(style.COLOURS):
                choices.append(some)
    return min(choices, key=lambda some: len(keys(numbers, others(factors, some))))


def others(factors, some):
    return tuple(factor for factor in factors if factor not in some)


def keys(numbers, factors):
    return list(dict.fromkeys(number.key(factors) for number in numbers))


def points(numbers, wording, name):
    """Means with their intervals, and every trial as a point behind them."""
    notes = gaps.notes(numbers, wording)
    numbers = [number for number in numbers if number.known]
    across = apart(numbers, wording.columns)
    down = others(numbers[0].levels, across)
    measures, rows, series = by_measure(numbers), keys(numbers, down), keys(numbers, across)
    require_few(len(rows), name)
    figure, axes = panel_grid(measures, [wording.levels(row) for row in rows], len(series))
    for ax, (measure, some) in zip(axes, measures.items()):
        handles = []
        for k, key in enumerate(series):
            own = [number for number in some if number.key(across) == key]
            places = [rows.index(number.key(down)) + offset(k, len(series)) for number in own]
            handles.append(marks(ax, own, places, k, wording.levels(key)))
        if wording.is_difference:
            ax.axvline(0, color="black", linewidth=0.5, zorder=0)
        ax.set_xlabel(wording.measure(measure))
        ax.grid(axis="y", color="#E8E8E8", linewidth=0.5)
    if len(series) == 1:  # rows say all
        handles, series = [], []
    legends.explain(figure, handles, series, wording, notes)
    return figure


def offset(k, count):
    """Of the k-th mark of a row from its middle."""
    return (k - 0.5 * (count - 1)) * 0.7 / count


def marks(ax, own, places, k, label):
    for number, place in zip(own, places):
        style.trials(ax, number.trials, [place] * len(number.trials), k)
    ax.hlines(places, [n.low for n in own], [n.high for n in own], color=style.colour(k),
              linewidth=0.9)
    mark = ax.plot([n.value for n in own], places, linestyle="none", color=style.colour(k),
                   marker=style.MARKERS[k], markersize=3, label=label or None)[0]
    style.opened(mark, [not n.reached for n in own])
    return mark


def bars(table, wording, axis, name_of):
    """First-order and total indices, those of pairs, Morris' mu* and sigma, or shares of a
    difference, with their intervals."""
    values = {column: table.column(column) for column in table.numbers}
    measures = list(dict.fromkeys(row["measure"] for row in table.rows))
    inside = {m: [i for i, row in enumerate(table.rows) if row["measure"] == m] for m in measures}
    shown = [c for c in table.numbers if not all(map(math.isnan, values[c]))]
    inside = {measure: [i for i in some if not all(math.isnan(values[c][i]) for c in shown)]
              for measure, some in inside.items()}
    inside = {measure: some for measure, some in inside.items() if some}
    if not inside:
        return None
    texts = list(dict.fromkeys(name_of(table.rows[i]) for some in inside.values() for i in some))
    require_few(len(texts), table.name)
    figure, axes = panel_grid(inside, texts, 2 * len(shown))
    handles = []
    for ax, (measure, some) in zip(axes, inside.items()):
        for k, column in enumerate(shown):
            low, high = table.bounds(column)
            own = [i for i in some if not math.isnan(values[column][i])]
            places = [texts.index(name_of(table.rows[i])) + offset(k, len(shown)) for i in own]
            handles.append(ax.barh(places, [values[column][i] for i in own], 0.6 / len(shown),
                                   color=style.colour(k), label=names.plain(column)))
            ax.hlines(places, [low[i] for i in own], [high[i] for i in own], color="black",
                      linewidth=0.8)
        ax.axvline(0, color="black", linewidth=0.5)
        ax.set_xlabel(axis(measure))
    if len(shown) > 1:
        legends.legend_above(figure, handles[:len(shown)])
    return figure
