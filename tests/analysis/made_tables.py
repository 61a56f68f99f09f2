"""Tables of the studies that ship, as `shoal tables` writes them, with numbers that were made up.

The program says which rows and columns they have, of a study of which hardly a trial ran: all of
them would take minutes. Sensitivities and attributions are computed, from short trials."""

import math
import re
import tomllib

STUDIES = ("assignment_energy", "current_estimation", "delta_theta", "local_minima",
           "ownship_weight", "potentials", "separation_and_noise", "settings_effects",
           "sobol_rigid", "test_bed_latency", "thesis_chapter5", "virtual_potentials")
STEPS = 25  # rows of a table of series
BOUNDS = {"mean": (), "mean +- ci95": ("_plus_minus",), "mean +- sd": ("_sd",),
          "mean [min, max]": ("_low", "_high"), "mean [bca95]": ("_low", "_high"),
          "median [q1, q3]": ("_low", "_high")}


def shortened(text):
    """A study of trials as short as its tables allow, without claims."""
    seconds = 40 if "[[sensitivity]]" in text else 1  # until what differs can be seen
    text = re.sub(r"^claims = .*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"base_samples = \d+", "base_samples = 8", text)
    text = re.sub(r", trial\.duration_s = \d+", "", text)
    head, tables = re.split(r"^(?=\[)", text, maxsplit=1, flags=re.MULTILINE)
    if "set = {" not in head:
        head += "set = { }\n"
    head = head.replace("set = {", f"set = {{ trial.duration_s = {seconds},").replace(", }", " }")
    return head + tables


def needs_trials(text):
    return bool({"sensitivity", "attribution"} & set(tomllib.loads(text)))


def steady(k):
    """Numbers as a study may well give them: they rise and fall by a third of their mean."""
    return 10.0 + 3.0 * math.sin(0.7 * k) + 0.02 * k


def fill(table, request, value=steady):
    """Gives the numbers of a table values, and the bounds and trials that its request asks for."""
    if request.get("series"):
        first, = table.labels
        table.rows[:] = [{**table.rows[0], first: str(k * request["every"])} for k in range(STEPS)]
    for r, row in enumerate(table.rows):
        for c, column in enumerate(table.numbers):
            mean = value(r + 5 * c)
            width = 0.1 * abs(mean or 0.0)
            low, high = ((mean or 0.0) + sign * width for sign in (-1, 1))
            bounds = {"": mean, "_plus_minus": width, "_sd": width, "_low": low, "_high": high}
            for ending in ("", *bounds_of(request, row, column)):
                row[column + ending] = "" if mean is None else repr(bounds[ending])
            if mean is not None and request.get("measures") and "factors" in request:
                row[column + "_each"] = " ".join(repr(mean + share * width)
                                                 for share in (-0.8, 0.1, 0.6))


def bounds_of(request, row, column):
    """Which bounds a request asks for; those of indices are there already."""
    if request.get("of") == "comparison":
        return BOUNDS["mean +- ci95"]
    if request.get("of") == "table":
        return BOUNDS[request.get("statistic", "mean +- ci95")]
    return [ending for ending in ("_low", "_high") if column + ending in row]
