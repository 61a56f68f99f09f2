"""Curves against a series or a factor of numbers; many of them in panels, one a level of another
factor."""

import itertools

import gaps
import legends
import matplotlib.ticker
import names
import panels
import style
from long_form import by_measure, without

FEW = 3  # different numbers that make a curve of a factor
MOST = len(style.COLOURS)  # curves of one axes
WIDE = 50  # times the least number is the greatest of an axis that is logarithmic


def axis_of(numbers, request):
    """The factor of numbers that curves are drawn against: the last of the rows, else of the
    columns; nothing where most curves would be points."""
    known = [number for number in numbers if number.known]
    in_columns = request.get("columns", [])
    factors = [f for f in (known[0].levels if known else ()) if f not in in_columns]
    for factor in [*reversed(factors), *reversed(in_columns)]:
        levels = {number.levels.get(factor, "") for number in known}
        if len(levels) < FEW or not all(map(names.is_number, levels)):
            continue
        curves = {(number.measure, without(number, {factor})) for number in known}
        if 2 * len(curves) <= len(known):
            return factor
    return None


def parted(known, against, name):
    """The factors whose levels have panels of their own: as few panels as leave no more curves in
    each than can be told apart."""
    levels = {}
    for number in known:
        for factor, level in number.levels.items():
            levels.setdefault(factor, set()).add(level)
    others = [factor for factor, some in levels.items() if factor != against and len(some) > 1]
    for count in range(len(others) + 1):
        choices = []
        for some in itertools.combinations(others, count):
            shown = {number.key(some) for number in known}
            curves = {without(number, {against, *some}) for number in known}
            if len(curves) <= MOST and len(shown) <= panels.MOST:
                choices.append((len(shown), some))
        if choices:
            return min(choices)[1]
    curves = len({without(number, {against}) for number in known})
    raise panels.TooMuch(f"{name} has {curves} curves, and a figure shows {MOST} in each of at "
                         f"most {panels.MOST} panels; select some with where in the request of "
                         f"{name}")


def curves(numbers, wording, against, name, of_measure):
    """One measure below another, called as `of_measure` says; in each panel the curves that differ in
    what panels do not."""
    measures = by_measure(numbers)
    known = [number for number in numbers if number.known]
    facets = parted(known, against, name)
    shown = list(dict.fromkeys(number.key(facets) for number in known))
    keys = list(dict.fromkeys(without(number, {against, *facets}) for number in known))
    across = panels.across(len(shown))
    down = -(-len(shown) // across)
    figure, axes = panels.grid(len(measures) * down * across, across, panels.panel_height(across),
                               sharex=True)
    handles = {}
    for row, (measure, some) in enumerate(measures.items()):
        block = axes[row * down * across:(row + 1) * down * across]
        for k, (ax, panel) in enumerate(zip(block, shown)):
            if k:
                ax.sharey(block[0])
            for j, key in enumerate(keys):
                own = [number for number in some if number.known and number.key(facets) == panel
                       and without(number, {against, *facets}) == key]
                if own:
                    line = draw(ax, own, against, j, wording.levels(key))
                    handles.setdefault(j, (line, key))
            if wording.is_difference:
                ax.axhline(0, color="black", linewidth=0.5, zorder=0)
            ax.set_title(names.sentence(wording.levels(panel, full=True)))
            if k % across == 0:
                ax.set_ylabel(of_measure(measure))
            lowest = row + 1 == len(measures) and k + across >= len(shown)
            ax.tick_params(labelleft=k % across == 0, labelbottom=lowest)
            if lowest:
                ax.set_xlabel(wording.axis(against))
        for ax in block[len(shown):]:
            ax.remove()
    x = [float(number.levels[against]) for number in known]
    if min(x) > 0 and max(x) > WIDE * min(x):
        logarithmic(figure.axes, 10)
    named = [handles[j] for j in sorted(handles)]
    if len(named) == 1 and not wording.compares(named[0][1]):  # axes say all
        named = []
    legends.explain(figure, [line for line, _ in named], [key for _, key in named], wording,
                    gaps.notes(numbers, wording, against))
    return figure


def logarithmic(axes, base):
    """For numbers that double again and again rather than grow by steps."""
    for ax in axes:
        ax.set_xscale("log", base=base)
        ax.xaxis.set_major_formatter(matplotlib.ticker.StrMethodFormatter("{x:g}"))
        ax.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def draw(ax, own, against, k, label):
    own = sorted(own, key=lambda number: float(number.levels[against]))
    x = [float(number.levels[against]) for number in own]
    line = style.curve(ax, x, [number.value for number in own], k, label=label or None)
    style.opened(line, [not number.reached for number in own])
    trials = [(place, each) for place, number in zip(x, own) for each in number.trials]
    if trials:
        style.trials(ax, *zip(*trials), k)
    style.band(ax, x, [number.low for number in own], [number.high for number in own], k)
    return line
