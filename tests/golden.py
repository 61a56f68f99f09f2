#!/usr/bin/env python3
"""Every scenario of the library with every behaviour that fits it, beside the numbers they gave before.

    tests/golden.py [--shoal PROGRAM] [--write]

tests/data/golden.csv holds mean and standard deviation of some measures over 24 seeds, for half an
hour of mission: a few seeds miss the rarer kind of trial where there are two (vehicles that do not
agree on a rotation). The check runs 3 seeds (of its own, so that the numbers are not just the same
bits) and accepts a mean within five standard errors of the difference: a change of the physics or of
an algorithm shows, the rounding of another machine does not. After a change that is meant, look at
what it prints, and --write the numbers anew.
"""

import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
GOLDEN = TOP / "tests" / "data" / "golden.csv"
DURATION_S = 1800
WRITTEN_SEEDS = range(1, 25)
CHECKED_SEEDS = range(101, 104)
MEASURES = ["energy_mean_wh", "thrust_time_ratio_mean", "thrust_distance_ratio_mean",
            "quality_final_m", "centroid_path_m", "efficiency_m_per_wh"]


def names(shoal, family):
    lines = subprocess.run([shoal, "list", family], check=True, text=True,
                           capture_output=True).stdout.splitlines()
    return [line.split()[0] for line in lines[1:]]


def run(shoal, scenario, behaviour, seed):
    with tempfile.TemporaryDirectory() as out:
        guidance = "conditioned_force" if behaviour == "virtual_potential" else "drift"
        subprocess.run([shoal, "run", scenario, "--seed", str(seed), "--out", out,
                        "--set", f"behaviour.kind={behaviour}", "--set", f"guidance.kind={guidance}",
                        "--set", f"trial.duration_s={DURATION_S}",
                        "--set", "trial.record_every_s=0"], check=True, stdout=subprocess.DEVNULL)
        metrics = json.loads((pathlib.Path(out) / "summary.json").read_text())["metrics"]
    return [metrics[name] for name in MEASURES]


def measure(shoal, seeds):
    """(scenario, behaviour) -> per measure, the values over the seeds."""
    # Behaviours of virtual potentials lead to waypoints, which only their own scenarios have; of
    # those the basin, with its 256 vehicles, is a matter of its study. Pair forces are for vehicles
    # that hear one another all the time.
    cases = [(s, b) for s in names(shoal, "scenario") if s != "potentials_basin"
             for b in names(shoal, "behaviour") if b != "pair_forces"
             if s.startswith("potentials_") == b.startswith("virtual_potential")]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {case: [pool.submit(run, shoal, *case, seed) for seed in seeds] for case in cases}
        return {case: list(zip(*(job.result() for job in runs))) for case, runs in jobs.items()}


def write(shoal):
    with GOLDEN.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scenario", "behaviour", "measure", "mean", "sd"])
        for (scenario, behaviour), columns in measure(shoal, WRITTEN_SEEDS).items():
            for name, values in zip(MEASURES, columns):
                writer.writerow([scenario, behaviour, name, f"{statistics.mean(values):.5g}",
                                 f"{statistics.stdev(values):.2g}"])
    return 0


def check(shoal):
    with GOLDEN.open() as file:
        golden = {(r["scenario"], r["behaviour"], r["measure"]): r for r in csv.DictReader(file)}
    standard_errors = 5 * math.sqrt(1 / len(WRITTEN_SEEDS) + 1 / len(CHECKED_SEEDS))
    wrong = 0
    for (scenario, behaviour), columns in measure(shoal, CHECKED_SEEDS).items():
        for name, values in zip(MEASURES, columns):
            known = golden.pop((scenario, behaviour, name), None)
            if known is None:
                print(f"{scenario} {behaviour} {name}: no golden number; run tests/golden.py --write")
                wrong += 1
                continue
            mean, before = statistics.mean(values), float(known["mean"])
            rounding = 5e-5 * abs(before)  # numbers are stored with five digits
            bound = standard_errors * float(known["sd"]) + rounding
            if abs(mean - before) > bound:
                print(f"{scenario} {behaviour} {name}: {mean:.5g}, was {before:.5g} +- {bound:.2g}")
                wrong += 1
    for scenario, behaviour, name in golden:
        print(f"{scenario} {behaviour} {name}: golden, but no longer there; run with --write")
        wrong += 1
    print(f"{wrong} of the measures differ from {GOLDEN.relative_to(TOP)}")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shoal", default=str(TOP / "build/release/bin/shoal"))
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    return write(options.shoal) if options.write else check(options.shoal)


if __name__ == "__main__":
    sys.exit(main())
