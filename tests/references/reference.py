"""Reading, writing and comparing the reference files of tests/data."""

import csv
import decimal
import math
import pathlib
import typing

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"


class Reference(typing.NamedTuple):
    """A file of tests/data, and what computes it.

    `results` gets all rows of the stored file, as {column: text}, and yields for each the entries
    that are not given but computed, as numbers or text.
    """

    name: str
    results: typing.Callable
    digits: int  # significant ones of a stored number
    tolerance: float  # largest difference, as a share of the largest stored number of a result


class Agreement:
    """Of all entries of one result: how many are the same, and the worst of the others."""

    def __init__(self):
        self.entries = self.same = 0
        self.largest = self.worst = 0.0
        self.line = None  # of the worst

    def add(self, line, stored, computed):
        self.entries += 1
        self.same += same(stored, computed)
        if same(stored, computed):
            difference = 0.0
        else:
            difference = abs(float(stored) - float(computed))
            if math.isnan(difference):  # only one of them is a number
                difference = math.inf
        if difference > self.worst:
            self.worst, self.line = difference, line
        if not math.isnan(float(stored)):
            self.largest = max(self.largest, abs(float(stored)))


def same(a, b):
    return a == b or decimal.Decimal(a) == decimal.Decimal(b)  # -0 is 0, and 4.0 is 4


def read(name):
    with open(DATA / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def computed(reference, rows):
    """For each row its results as text."""
    for results in reference.results(rows):
        yield {column: value if isinstance(value, str) else f"{value:.{reference.digits}g}"
               for column, value in results.items()}


def write(reference):
    rows = read(reference.name)
    made = [row | results for row, results in zip(rows, computed(reference, rows), strict=True)]
    path = DATA / reference.name
    line_end = "\r\n" if b"\r\n" in path.read_bytes() else "\n"
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator=line_end)
        writer.writeheader()
        writer.writerows(made)


def agreements(reference):
    """{result: Agreement} of the stored file with what is computed."""
    found = {}
    rows = read(reference.name)
    for line, (row, results) in enumerate(zip(rows, computed(reference, rows), strict=True), 2):
        for column, value in results.items():
            name = row.get("quantity", column)  # a file may have one number in a line
            found.setdefault(name, Agreement()).add(line, row[column], value)
    return found
