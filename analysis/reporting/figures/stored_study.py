"""What a folder of `shoal sweep` holds for figures: its tables, as `shoal tables` wrote them."""

import csv
import itertools
import math
import re
import tomllib

from recorded_run import NoRun

# What tables say besides their numbers, and what has a look of its own.
NO_NUMBERS = {"claims"}
# Of few trials, sensitivities and attributions have no intervals that would tell their numbers.
INDICES = {"first_order", "total", "second_order", "mu_star", "sigma", "share", "alone", "last"}
REACHED = re.compile(r"\bby (\d+) of (\d+)")


class StudyTable:
    """Rows with labels, and numbers with their bounds."""

    def __init__(self, name, caption, rows):
        self.name, self.caption, self.rows = name, caption, rows
        header = list(rows[0]) if rows else []
        known = INDICES if {"measure", "factor"} <= set(header) else set()
        self.numbers = [c for c in header
                        if c + "_n" in header or c + "_low" in header or c in known]
        # What says of which row it is stands before all numbers.
        self.labels = header[:header.index(self.numbers[0])] if self.numbers else header

    def factor(self, label):
        """The factor of a column of labels, which numbers may have left no place for its name."""
        name = label.removesuffix("_label")
        return name if name in self.numbers else label

    def column(self, name):
        return [number(row[name]) for row in self.rows]

    def bounds(self, name):
        """Least and greatest of each number; the number itself where nothing is known."""
        values = self.column(name)
        for ending in ("_sd", "_plus_minus"):
            if name + ending in self.rows[0]:
                by = [0.0 if math.isnan(b) else b for b in self.column(name + ending)]
                return [v - b for v, b in zip(values, by)], [v + b for v, b in zip(values, by)]
        if name + "_low" in self.rows[0]:
            return tuple([v if math.isnan(b) else b
                          for v, b in zip(values, self.column(name + ending))]
                         for ending in ("_low", "_high"))
        return values, values

    def counts(self, name, ending):
        """Of its trials, by number: those that failed, or have not run; none where not known."""
        return [int(row.get(f"{name}_{ending}") or 0) for row in self.rows]

    def all_reached(self, name):
        """Whether what a number is a time to was reached by all its trials: a column, or of
        differences a remark, counts those that did."""
        return [all(int(some) >= int(of) for some, of in
                    [*REACHED.findall(row.get(name + "_remarks") or ""),
                     (row.get(name + "_reached") or row.get(name + "_n") or 0,
                      row.get(name + "_n") or 0)])
                for row in self.rows]

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
        study = tomllib.loads((folder / "study.toml").read_text(encoding="utf-8"))
        files = {file.stem: file for file in sorted((folder / "tables").glob("*.csv"))}
        if not files:
            raise NoRun(f"{folder} has no tables; shoal tables {folder} writes them")
        self.requests = requests_of(study)
        self.tables = {}
        for name in [*self.requests, *(n for n in files if n not in self.requests)]:
            if name in files and name not in NO_NUMBERS:
                with open(files[name], newline="", encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
                caption = self.requests.get(name, {}).get("caption", name)
                self.tables[name] = StudyTable(name, caption, rows)

    def request_of(self, table):
        """What a table answers; nothing of the usual one of a study that asks for none."""
        return self.requests.get(table.name, {})


def requests_of(study):
    """name -> what was asked for, of which kind, and with which factors of the study."""
    requests = {}
    for kind in ("table", "comparison", "sensitivity", "attribution"):
        for request in study.get(kind, []):
            asked = {**request, "of": kind, "factors": factors_of(study)}
            requests[request["name"]] = asked
            if kind == "sensitivity":
                requests |= {request["name"] + part: asked
                             for part in ("_second_order", "_convergence")}
    return requests


def factors_of(study):
    """name -> (its levels, the option that it sets, if that is one)."""
    groups = study.get("group", [])
    factors = {"group": ([group.get("name", "") for group in groups], "")}
    for factor in itertools.chain(*(part.get("factor", []) for part in (study, *groups))):
        key = factor.get("key", "").rpartition(".")[2]
        levels, _ = factors.setdefault(factor.get("name", key), ([], key))
        own = [level["label"] for level in factor.get("level", [])] or factor.get("values", [])
        levels += [label for label in map(label_of, own) if label not in levels]
    return factors


def label_of(value):
    """As tables write a level."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else str(value)
