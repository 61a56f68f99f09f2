#!/usr/bin/env python3
"""Compares shoal with the thesis author's logged Red Sea trials, side by side.

    tests/agreement.py [--shoal PROGRAM] [--shared DIR] [--seeds N] [--jobs N] [--assignment]

Runs redsea_square_as_run on the reconstructed current, from the published starts, and prints the
means over the seeds beside the log. The public data is not part of the repository: it is looked for
in $SHOAL_SHARED, else in ../shared. With --assignment, the assignment behaviour is compared as a
function of how old its targets and commands are, instead.
Exit status 1 if a mean lies outside its bound.
"""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent

# label of the log: (behaviour, start file, deploy after the current's time zero in s)
TRIALS = {
    "BHV2_Pairwise_Neighbour_Ref": ("pairwise_referencing", "pairwise_1.csv", 91.2),
    "BHV3_Rigid_Neighbour_Reg": ("rigid_registration", "rigid_1.csv", 59.0),
    "BHV4_Assignment_Registration": ("assignment_registration", "assignment_1.csv", 53.3),
}

# our measure: (column of the log, bound, whether the bound is relative)
MEASURES = {
    "thrust_time_ratio_mean": ("time_thrust_ratio_mean", 0.015, False),
    "thrust_distance_ratio_mean": ("dist_thrust_ratio_of_means", 0.03, False),
    "centroid_displacement_m": ("centroid_displacement_m", 0.10, True),
    "quality_settled_m": ("Q_mean_last3h_m", 0.20, True),
    "energy_mean_wh": ("E_total_mean_Wh", 0.15, True),
    "efficiency_m_per_wh": ("m_per_Wh_path", 0.15, True),
}
WIDER = {"pairwise_referencing": 0.20, "assignment_registration": 0.20}
ENERGIES = ("energy_mean_wh", "efficiency_m_per_wh")


def shoal(options, scenario, seed, settings):
    """The measures of one run."""
    with tempfile.TemporaryDirectory() as out:
        command = [str(options.shoal), "run", scenario, "--seed", str(seed), "--out", out]
        for key, value in {"trial.record_every_s": 0, **settings}.items():
            command += ["--set", f"{key}={value}"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.loads((pathlib.Path(out) / "summary.json").read_text())["measures"]


def run(options, trial, seed, settings):
    behaviour, start, offset = TRIALS[trial]
    data = options.shared / "data"
    return shoal(options, "redsea_square_as_run", seed, {
        "behaviour.kind": behaviour,
        "current.netcdf.file": data / "redsea_current.nc",
        "current.netcdf.time_offset_s": offset,
        "swarm.start.kind": "file",
        "swarm.start.file.path": data / "starts" / start,
        **settings,
    })


def means(options, trial, settings):
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        seeds = range(1, options.seeds + 1)
        runs = list(pool.map(lambda seed: run(options, trial, seed, settings), seeds))
    return {name: sum(r[name] for r in runs) / len(runs) for name in MEASURES}


def compare(options, log, trial, settings):
    """Prints a table; returns how many means lie outside their bounds."""
    behaviour = TRIALS[trial][0]
    ours = means(options, trial, settings)
    outside = 0
    print(f"\n{behaviour}: mean of {options.seeds} seeds beside the log {trial}")
    print(f"  {'measure':<28}{'shoal':>10}{'log':>10}{'difference':>12}{'bound':>9}")
    for name, (column, bound, relative) in MEASURES.items():
        if name in ENERGIES:
            bound = WIDER.get(behaviour, bound)
        theirs = float(log[trial][column])
        difference = ours[name] / theirs - 1 if relative else ours[name] - theirs
        shown, limit = (f"{difference:+.1%}", f"{bound:.0%}") if relative else (
            f"{difference:+.4f}", f"{bound:.3f}")
        verdict = "" if abs(difference) <= bound else "  outside"
        outside += verdict != ""
        print(f"  {name:<28}{ours[name]:>10.4g}{theirs:>10.4g}{shown:>12}{limit:>9}{verdict}")
    return outside


def assignment_by_age(options, log):
    """How the assignment behaviour depends on the instants at which it is refreshed."""
    trial = "BHV4_Assignment_Registration"
    print(f"\nassignment_registration, mean of {options.seeds} seeds, by the period at which targets "
          "and commands are renewed")
    names = ["thrust_time_ratio_mean", "thrust_distance_ratio_mean", "energy_mean_wh",
             "efficiency_m_per_wh", "quality_settled_m", "centroid_displacement_m"]
    print(f"  {'period_s':<10}" + "".join(f"{name:>28}" for name in names))

    def row(label, values):
        print(f"  {label:<10}" + "".join(f"{values[name]:>28.4g}" for name in names), flush=True)

    row("ping", means(options, trial, {"planner.update": "ping"}))
    logged = {name: float(log[trial][MEASURES[name][0]]) for name in names}
    below = None
    found = None
    for period in options.periods:
        ours = means(options, trial, refreshed_every(period))
        row(f"{period:g}", ours)
        here = (period, ours["thrust_time_ratio_mean"])
        wanted = logged["thrust_time_ratio_mean"]
        if below and below[1] < wanted <= here[1]:
            share = (wanted - below[1]) / (here[1] - below[1])
            found = round((below[0] + share * (here[0] - below[0])) / TICK_S) * TICK_S
        below = here
    row("log", logged)
    if found is None:
        print("  no period among these agrees with the logged thrust time ratio")
        return 1
    print(f"\nThe thrust time ratio agrees with the log at {found:g} s, between two of these.", end="")
    return compare(options, log, trial, refreshed_every(found))


TICK_S = 0.25


def refreshed_every(period_s):
    return {"planner.update": "tick", "planner.period_s": period_s, "guidance.drift.period_s": period_s}


# scenario, behaviour, turn of the formation in degrees, read off the thesis' figures 5.45, 5.46, 5.28
TURNS = [
    ("maintenance_vortex_hexagonal", "pairwise_referencing", 160),
    ("maintenance_vortex_square", "rigid_registration", 135),
    ("maintenance_channels_square", "rigid_registration", -30),
]


def maintenance(options):
    """How far the formation turns in 7200 s as the program ran, beside the thesis' figures."""
    outside = 0
    print(f"\nturn of the formation in 7200 s, mean of {options.seeds} seeds beside the thesis")
    print(f"  {'scenario':<30}{'behaviour':<22}{'shoal':>8}{'thesis':>8}{'bound':>7}")
    for scenario, behaviour, thesis in TURNS:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            runs = list(pool.map(
                lambda seed: shoal(options, scenario, seed, {"behaviour.kind": behaviour,
                                                             "inherits": "program"}),
                range(1, options.seeds + 1)))
        ours = sum(r["formation_rotation_deg"] for r in runs) / len(runs)
        verdict = "" if abs(ours - thesis) <= 20 else "  outside"
        outside += verdict != ""
        print(f"  {scenario:<30}{behaviour:<22}{ours:>8.1f}{thesis:>8}{20:>7}{verdict}")
    return outside


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shoal", type=pathlib.Path, default=TOP / "build/release/bin/shoal")
    parser.add_argument("--shared", type=pathlib.Path,
                        default=os.environ.get("SHOAL_SHARED", TOP.parent / "shared"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--assignment", action="store_true")
    parser.add_argument("--periods", type=float, nargs="+", default=[10, 15, 20, 25, 30, 35])
    options = parser.parse_args()
    options.shared = pathlib.Path(options.shared)
    trials = options.shared / "data" / "redsea_trials.csv"
    if not trials.exists():
        print(f"skipped: {trials} is not here; set SHOAL_SHARED to the folder of public data")
        return 0
    with trials.open() as file:
        log = {row["behaviour"]: row for row in csv.DictReader(file)}
    if options.assignment:
        return 1 if assignment_by_age(options, log) else 0
    outside = sum(compare(options, log, trial, {}) for trial in list(TRIALS)[:2])
    outside += maintenance(options)
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(main())
