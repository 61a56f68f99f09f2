#!/usr/bin/env python3
"""Every scenario of the library with every behaviour that fits it, beside the numbers they gave before.

    tests/golden.py [--shoal PROGRAM] [--write]

tests/data/golden.csv holds some measures of three seeds for half an hour of mission. The same seed gives
the same numbers, so the check accepts no difference: any change of the physics or of an algorithm shows,
also one much smaller than the spread over seeds. After a change that is meant, look at what it prints,
explain it where the change is made, and --write the numbers anew. The numbers depend on how the C library
rounds sines and exponentials: with another one, --write those of a version that is trusted first.
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
GOLDEN = TOP / "tests" / "data" / "golden.csv"
DURATION_S = 1800
SEEDS = (101, 102, 103)
SAME = 1e-11  # what rounding of the stored numbers, twelve digits, leaves
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
        measures = json.loads((pathlib.Path(out) / "summary.json").read_text())["measures"]
    return [measures[name] for name in MEASURES]


def measure(shoal):
    """(scenario, behaviour) -> per measure, its value for each seed."""
    # Behaviours of virtual potentials lead to waypoints, which only their own scenarios have; of
    # those the basin, with its 256 vehicles, is a matter of its study. Pair forces are for vehicles
    # that hear one another all the time.
    cases = [(s, b) for s in names(shoal, "scenario") if s != "potentials_basin"
             for b in names(shoal, "behaviour") if b != "pair_forces"
             if s.startswith("potentials_") == b.startswith("virtual_potential")]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {case: [pool.submit(run, shoal, *case, seed) for seed in SEEDS] for case in cases}
        return {case: list(zip(*(job.result() for job in runs))) for case, runs in jobs.items()}


def write(shoal):
    with GOLDEN.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scenario", "behaviour", "measure", *(f"seed {seed}" for seed in SEEDS)])
        for (scenario, behaviour), columns in measure(shoal).items():
            for name, values in zip(MEASURES, columns):
                writer.writerow([scenario, behaviour, name, *(f"{value:.12g}" for value in values)])
    return 0


def same(one, other):
    return abs(one - other) <= SAME * max(abs(one), abs(other))


def check(shoal):
    with GOLDEN.open() as file:
        golden = {(r["scenario"], r["behaviour"], r["measure"]): [float(r[f"seed {s}"]) for s in SEEDS]
                  for r in csv.DictReader(file)}
    wrong = 0
    for (scenario, behaviour), columns in measure(shoal).items():
        for name, values in zip(MEASURES, columns):
            before = golden.pop((scenario, behaviour, name), None)
            if before is None:
                print(f"{scenario} {behaviour} {name}: no golden numbers; run tests/golden.py --write")
                wrong += 1
            elif not all(map(same, values, before)):
                moved = ", ".join(f"{was:.6g} -> {now:.6g}" for was, now in zip(before, values))
                print(f"{scenario} {behaviour} {name}: {moved}")
                wrong += 1
    for scenario, behaviour, name in golden:
        print(f"{scenario} {behaviour} {name}: golden, but no longer there; run with --write")
        wrong += 1
    print(f"{wrong} of the measures differ from {GOLDEN.relative_to(TOP)}")
    if wrong:
        print("the same seed gives the same numbers: a change of them is a change of a model, to be "
              "explained where it is made; then run with --write")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shoal", default=str(TOP / "build/release/bin/shoal"))
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    return write(options.shoal) if options.write else check(options.shoal)


if __name__ == "__main__":
    sys.exit(main())
