"""A table of a study as one row a number, wherever its request put factors: in rows or in
columns."""

import dataclasses
import itertools
import math

import names
from stored_study import label_of

UNNAMED = ""  # the factors that columns show, where their names cannot be told apart


@dataclasses.dataclass(frozen=True)
class Number:
    """A number of a table, and the trials behind it."""

    measure: str
    levels: dict  # factor -> level: those of rows, then those of columns
    value: float
    low: float
    high: float
    trials: list
    reached: bool = True  # by all trials, if it is the time to an event
    failed: int = 0
    not_run: int = 0

    @property
    def known(self):
        return not math.isnan(self.value)

    @property
    def lost(self):
        """Without a value, though trials were to give it one."""
        return not self.known and self.failed + self.not_run > 0

    def key(self, factors):
        return tuple((factor, self.levels.get(factor, "")) for factor in factors)


def numbers_of(table, request):
    """Row by row. Of a measure that stands in the rows, the columns are its kinds of numbers."""
    in_rows = "measure" in table.labels
    places = {} if in_rows else columns_of(request)
    found = []
    for column in table.numbers:
        measure, levels = places.get(column) or guessed(column, request)
        if in_rows:
            measure, levels = "", {UNNAMED: column} if len(table.numbers) > 1 else {}
        numbers = zip(table.column(column), *table.bounds(column), table.each(column),
                      table.all_reached(column), table.counts(column, "failed"),
                      table.counts(column, "not_run"))
        found.append([(row.get("measure", measure), levels, *number)
                      for row, number in zip(table.rows, numbers)])
    numbers = []
    for row, across in zip(table.rows, zip(*found)):
        own = {table.factor(label): row[label] for label in table.labels if label != "measure"}
        numbers += [Number(measure, {**own, **levels}, *rest) for measure, levels, *rest in across]
    return numbers


def columns_of(request):
    """column -> (measure, levels), of a request that names its measures and a study that lists its
    levels."""
    measures = request.get("measures") or request.get("series") or []
    factors = request.get("columns", [])
    levels = [request.get("factors", {}).get(factor, ([], ""))[0] for factor in factors]
    return {"_".join([*some, measure]): (measure, dict(zip(factors, some)))
            for some in itertools.product(*levels) for measure in measures}


def guessed(column, request):
    """(measure, levels) of a column that is not among those: its measure is known by its end."""
    measures = request.get("measures") or request.get("series") or []
    measure = next((m for m in sorted(measures, key=len, reverse=True) if column.endswith(m)), column)
    level = column.removesuffix(measure).strip("_")
    return measure, {UNNAMED: level} if level else {}


def by_measure(numbers):
    """measure -> its numbers; of measures that have any value."""
    found = {}
    for number in numbers:
        found.setdefault(number.measure, []).append(number)
    return {measure: some for measure, some in found.items() if any(n.known for n in some)}


def without(number, factors):
    """Its levels of all other factors, as a key."""
    return number.key(factor for factor in number.levels if factor not in factors)


class Wording:
    """What a figure calls the factors, levels and measures of a request."""

    def __init__(self, request):
        self.request = request
        self.columns = set(request.get("columns", [])) | {UNNAMED}
        self.is_difference = request.get("of") == "comparison"

    def factor(self, name):
        """(words, unit): that of the option which a factor sets, if its own name has none."""
        text, unit = names.parted(name)
        option = self.request.get("factors", {}).get(name, ([], ""))[1]
        return text, unit or names.parted(option)[1]

    def axis(self, name):
        return names.sentence(names.with_unit(*self.factor(name)))

    def level(self, factor, level, full=False):
        """A number needs a unit, or the name of its factor, to say what it is; in full, both."""
        if factor == UNNAMED or not names.is_number(level):
            return names.plain(level)
        text, unit = self.factor(factor)
        if not unit:
            return f"{text} {level}"
        return f"{text} {level} {unit}" if full else f"{level} {unit}"

    def levels(self, key, full=False):
        """Of factors that do not apply there is nothing to say; a dash, as in tables, if none
        does."""
        texts = [self.level(*part, full) for part in key if part[1]]
        return ", ".join(texts) or ("-" if any(factor != UNNAMED for factor, _ in key) else "")

    def measure(self, measure):
        """Of a comparison, that it is a difference, and from what."""
        text, unit = self.measure_parts(measure)
        if self.is_difference:
            reference = self.level(self.request["factor"], label_of(self.request["reference"]),
                                   full=True)
            text = f"{text}: difference from {reference}"
        return names.sentence(names.with_unit(text, unit))

    def compares(self, key):
        """Whether a key says what is compared with the reference of a comparison."""
        return self.is_difference and self.request["factor"] in dict(key)

    def total(self, measure):
        return names.sentence(f"total index of {self.measure_parts(measure)[0]}")

    def variance(self, measure):
        return names.sentence(f"share of the variance of {self.measure_parts(measure)[0]}")

    def effect(self, measure):
        text, unit = self.measure_parts(measure)
        return names.sentence(names.with_unit(f"effect on {text}", unit))

    def change(self, measure):
        """What is attributed may be how much more there is than in another group."""
        text, unit = self.measure_parts(measure)
        minus = self.request.get("minus", "")
        beyond = f" beyond that of {names.plain(minus)}" if minus else ""
        return names.sentence(names.with_unit(f"effect on {text}{beyond}", unit))

    def measure_parts(self, measure):
        """(words, unit) of a measure as a table names it: by its name, or in words with its unit."""
        if measure.endswith(")") and " (" in measure:
            text, _, unit = measure.removesuffix(")").rpartition(" (")
            return names.plain(text), unit
        asked = [m for m in self.request.get("measures", []) if names.parted(m)[0] == measure]
        return names.parted(asked[0] if asked else measure)
