"""What a folder of `shoal sweep` holds for figures: its tables, as `shoal tables` wrote them."""

import csv
import math
import tomllib

from recorded_run import NoRun

# What tables say besides their numbers, and what has a look of its own.
NO_NUMBERS = {"claims"}


class StudyTable:
    """Rows with labels, and numbers with their bounds."""

    def __init__(self, name, caption, rows):
        self.name, self.caption, self.rows = name, caption, rows
        header = list(rows[0]) if rows else []
        self.numbers = [c for c in header if c + "_n" in header or c + "_low" in header]
        # What says of which row it is stands before all numbers.
        self.labels = header[:header.index(self.numbers[0])] if self.numbers else header

    def column(self, name):
        return [number(row[name]) for row in self.rows]

    def bounds(self, name):
        """Least and greatest of each number; the number itself where nothing is known."""
        values = self.column(name)
        if name + "_sd" in self.rows[0]:
            by = self.column(name + "_sd")
            return [v - b for v, b in zip(values, by)], [v + b for v, b in zip(values, by)]
        if name + "_plus_minus" in self.rows[0]:
            by = [0.0 if math.isnan(b) else b for b in self.column(name + "_plus_minus")]
            return [v - b for v, b in zip(values, by)], [v + b for v, b in zip(values, by)]
        if name + "_low" in self.rows[0]:
            return self.column(name + "_low"), self.column(name + "_high")
        return values, values


    def each(self, name):
        """The trials behind each number; none where they are not known."""
        texts = [row.get(name + "_each") or "" for row in self.rows]
        return [[float(x) for x in text.split()] for text in texts]


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


class StoredStudy:
    """The tables of a study by name, in its order, with the requests that they answer."""

    def __init__(self, folder):
        try:
            study = tomllib.loads((folder / "study.toml").read_text())
        except (tomllib.TOMLDecodeError, OSError) as error:
            raise NoRun(f"{folder} is damaged: {error}") from error
        files = {file.stem: file for file in sorted((folder / "tables").glob("*.csv"))}
        if not files:
            raise NoRun(f"{folder} has no tables; shoal tables {folder} writes them")
        self.requests = {}
        for kind in ("table", "comparison", "sensitivity"):
            for request in study.get(kind, []):
                self.requests[request["name"]] = {**request, "of": kind}
        self.tables = {}
        for name in [*self.requests, *(n for n in files if n not in self.requests)]:
            if name in files and name not in NO_NUMBERS:
                with open(files[name], newline="", encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
                caption = self.requests.get(name, {}).get("caption", name)
                self.tables[name] = StudyTable(name, caption, rows)
