"""Figures of a study: one for each of its tables that has numbers, by what stands in its rows."""

import curves
import names
import rows
from long_form import UNNAMED, Number, Wording, numbers_of


def figure_of(table, request):
    """Curves with envelopes against time or another series, and against a factor of numbers; bars
    for the indices of a sensitivity; else points with their intervals. Nothing for an empty
    table."""
    if not table.rows or not table.numbers:
        return None
    wording = Wording(request)
    if {"measure", "factor"} <= set(table.labels) and not wording.is_difference:
        return of_indices(table, wording)
    numbers = numbers_of(table, request)
    if not any(number.known for number in numbers):
        return None
    against = curves.axis_of(numbers, request)
    if against:
        return curves.curves(numbers, wording, against, table.name, wording.measure)
    return rows.points(numbers, wording, table.name)


def of_indices(table, wording):
    if "base_samples" in table.labels:
        return convergence(table, wording)
    if "share" in table.numbers:
        return rows.bars(table, wording, wording.change, change)
    if "mu_star" in table.numbers:
        return rows.bars(table, wording, wording.effect, factors)
    return rows.bars(table, wording, wording.variance, factors)


def factors(row):
    return " and ".join(names.words(row[label]) for label in ("factor", "and_factor")
                        if label in row)


def change(row):
    """Of a row that shows what a change of a factor does; all changes together have no levels."""
    if not row["to"]:
        return f"{row['factor']} changes"
    return f"{names.words(row['factor'])}, {names.plain(row['from'])} to {names.plain(row['to'])}"


def convergence(table, wording):
    """Total indices against the number of samples."""
    total = table.numbers[-1]
    numbers = [Number(row["measure"], {UNNAMED: row["factor"], "base_samples": row["base_samples"]},
                      value, low, high, [])
               for row, value, low, high
               in zip(table.rows, table.column(total), *table.bounds(total))]
    if not any(number.known for number in numbers):
        return None
    figure = curves.curves(numbers, wording, "base_samples", table.name, wording.total)
    curves.logarithmic(figure.axes, 2)
    return figure
