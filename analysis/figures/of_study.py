"""Figures of a study: one for each of its tables that has numbers, by what stands in its rows."""

import math

import matplotlib.pyplot as plt
import style

FEW = 3  # different numbers that make a curve of a factor


def figure_of(table, request):
    """Curves with envelopes against time or another series, and against a factor of numbers; bars for
    the indices of a sensitivity; else points with their intervals. Nothing for an empty table."""
    if not table.rows or not table.numbers:
        return None
    if request.get("of") == "sensitivity" or {"metric", "factor"} <= set(table.labels):
        return convergence(table) if "base_samples" in table.labels else indices(table)
    against = curve_axis(table)
    return curves(table, request, against) if against else points(table, request)


def curve_axis(table):
    """The last label that has numbers enough for a curve."""
    for label in reversed(table.labels):
        values = table.column(label)
        if not any(map(math.isnan, values)) and len(set(values)) >= FEW:
            return label
    return None


def panels(table, request):
    """(metric, its rows, its columns with the level of each) of those that a table shows."""
    everything = range(len(table.rows))
    if "metric" in table.labels:
        columns = [(column, "" if len(table.numbers) == 1 else column) for column in table.numbers]
        for metric in dict.fromkeys(row["metric"] for row in table.rows):
            yield metric, [i for i in everything if table.rows[i]["metric"] == metric], columns
        return
    metrics = request.get("metrics") or request.get("series") or []
    found = {}
    for column in table.numbers:
        metric = next((m for m in sorted(metrics, key=len, reverse=True) if column.endswith(m)), column)
        found.setdefault(metric, []).append((column, column.removesuffix(metric).strip("_")))
    for metric, columns in found.items():
        yield metric, list(everything), columns


UNITS = {"_m_per_wh": "m/Wh", "_m_per_h": "m/h", "_m_s": "m/s", "_wh": "Wh", "_deg": "deg", "_m": "m",
         "_s": "s", "_w": "W", "_h": "h"}


def words(name):
    """`energy_mean_wh` as `energy mean (Wh)`."""
    for ending, unit in UNITS.items():
        if name.endswith(ending):
            return f"{name.removesuffix(ending).removesuffix(ending)} ({unit})".replace("_", " ")
    return name.replace("_", " ")


def sentence(name):
    text = words(name)
    return text[:1].upper() + text[1:]


def axes_for(count, height=0.7):
    figure, axes = plt.subplots(count, 1, squeeze=False)
    figure.set_figheight(figure.get_figwidth() * height * (0.35 + 0.65 * count))
    return figure, axes[:, 0]


def curves(table, request, against):
    shown = list(panels(table, request))
    others = [label for label in table.labels if label not in (against, "metric")]
    figure, axes = axes_for(len(shown))
    for ax, (metric, inside, columns) in zip(axes, shown):
        line = 0
        for column, level in columns:
            low, high = table.bounds(column)
            values, places = table.column(column), table.column(against)
            keys = {i: tuple(table.rows[i][o] for o in others) for i in inside}
            for key in dict.fromkeys(keys.values()):
                rows = [i for i in inside if keys[i] == key and not math.isnan(values[i])]
                if not rows:
                    continue
                rows.sort(key=lambda i: places[i])
                trials = [(places[i], y) for i in rows for y in table.each(column)[i]]
                x = [places[i] for i in rows]
                label = ", ".join(words(part) for part in (*key, level) if part)
                look = {"color": style.colour(line),
                        "linestyle": "-" if line < len(style.COLOURS) else "--"}
                ax.plot(x, [values[i] for i in rows], label=label or None,
                        marker="." if len(x) < 30 else None, markersize=3, **look)
                if trials:
                    ax.plot(*zip(*trials), "o", color=look["color"], markersize=2.2, alpha=0.3,
                            markeredgewidth=0)
                ax.fill_between(x, [low[i] for i in rows], [high[i] for i in rows],
                                color=look["color"], alpha=0.15, linewidth=0)
                line += 1
        ax.set_ylabel(sentence(metric))
        if line > 1:
            ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    axes[-1].set_xlabel(sentence(against))
    return figure


def rows_down(ax, names):
    ax.set_yticks(range(len(names)), names)
    ax.set_ylim(len(names) - 0.5, -0.5)


def indices(table):
    """First-order and total indices, or those of pairs (or Morris' mu* and sigma), with their intervals."""
    metrics = list(dict.fromkeys(row["metric"] for row in table.rows))
    figure, axes = axes_for(len(metrics), 0.5)
    for ax, metric in zip(axes, metrics):
        rows = [i for i, row in enumerate(table.rows) if row["metric"] == metric]
        shown = [column for column in table.numbers
                 if not all(math.isnan(table.column(column)[i]) for i in rows)]
        width = 0.8 / len(shown)
        for k, column in enumerate(shown):
            low, high = table.bounds(column)
            value = table.column(column)
            place = [row + (k - 0.5 * (len(shown) - 1)) * width for row in range(len(rows))]
            ax.barh(place, [value[i] for i in rows], 0.9 * width, color=style.colour(k),
                    label=words(column))
            ax.hlines(place, [low[i] for i in rows], [high[i] for i in rows], color="black",
                      linewidth=0.8)
        ax.axvline(0, color="black", linewidth=0.5)
        rows_down(ax, [" and ".join(words(table.rows[i][label]) for label in ("factor", "and_factor")
                                    if label in table.rows[i]) for i in rows])
        ax.set_title(sentence(metric), fontsize=8)
    axes[0].legend(loc="lower right")
    return figure


def convergence(table):
    """Indices against the number of samples."""
    metrics = list(dict.fromkeys(row["metric"] for row in table.rows))
    column = table.numbers[-1]
    figure, axes = axes_for(len(metrics), 0.6)
    low, high = table.bounds(column)
    value, samples = table.column(column), table.column("base_samples")
    for ax, metric in zip(axes, metrics):
        factors = dict.fromkeys(row["factor"] for row in table.rows if row["metric"] == metric)
        for k, factor in enumerate(factors):
            rows = [i for i, row in enumerate(table.rows)
                    if row["metric"] == metric and row["factor"] == factor]
            x = [samples[i] for i in rows]
            ax.plot(x, [value[i] for i in rows], color=style.colour(k), label=words(factor))
            ax.fill_between(x, [low[i] for i in rows], [high[i] for i in rows], alpha=0.15,
                            color=style.colour(k), linewidth=0)
        ax.set_xscale("log", base=2)
        ax.set_ylabel(f"{words(column)}, {metric}")
    axes[0].legend(loc="best", ncol=2)
    axes[-1].set_xlabel("Base samples")
    return figure


def points(table, request):
    """Means with their intervals, and every trial as a point behind them."""
    shown = list(panels(table, request))
    labels = [label for label in table.labels if label != "metric"]
    figure, axes = axes_for(len(shown), min(1.2, 0.18 + 0.07 * len(shown[0][1])))
    for ax, (metric, inside, columns) in zip(axes, shown):
        names = [", ".join(words(table.rows[i][label]) for label in labels) for i in inside]
        for k, (column, level) in enumerate(columns):
            low, high = ([bound[i] for i in inside] for bound in table.bounds(column))
            value = [table.column(column)[i] for i in inside]
            place = [i + (k - 0.5 * (len(columns) - 1)) * 0.7 / len(columns)
                     for i in range(len(names))]
            for y, trials in zip(place, [table.each(column)[i] for i in inside]):
                ax.plot(trials, [y] * len(trials), "o", color=style.colour(k), markersize=2.2,
                        alpha=0.3, markeredgewidth=0)
            ax.hlines(place, low, high, color=style.colour(k), linewidth=0.9)
            ax.plot(value, place, "o", color=style.colour(k), markersize=3,
                    label=words(level) or None)
        rows_down(ax, names)
        ax.set_xlabel(sentence(metric))
        ax.grid(axis="y", color="#E8E8E8", linewidth=0.5)
        if len(columns) > 1:
            ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    return figure


def profiles(rows):
    """Performance profiles of Dolan and Moré 2002: the share of the problems that a solver solves at no
    more than so many times the price of the best."""
    kinds = list(dict.fromkeys((row["family"], row["measure"]) for row in rows))
    figure, axes = axes_for(len(kinds))
    for ax, kind in zip(axes, kinds):
        own = [row for row in rows if (row["family"], row["measure"]) == kind]
        for k, solver in enumerate(dict.fromkeys(row["solver"] for row in own)):
            steps = [(float(row["factor"]), float(row["share"])) for row in own
                     if row["solver"] == solver]
            ax.step(*zip(*steps), where="post", color=style.colour(k), label=solver)
        ax.set_xscale("log", base=2)
        ax.set_ylim(0, 1.02)
        ax.set_ylabel(f"Share ({kind[0]})")
        ax.set_xlabel(f"Times the {kind[1]} of the best")
        ax.legend(loc="lower right")
    return figure
