#!/usr/bin/env python3
"""The same scenario gives the same bits, whatever compiled the program.

    tests/same_bits.py PROGRAM PROGRAM [--scenarios N] [--first K] [--jobs J]

Draws scenarios of the library with a behaviour, a vehicle's noise, losses, solvers and numbers of its
own, runs each for some minutes with both programs, and compares every recorded bit and every measure.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

import netCDF4


def names(program, family):
    """Members of a family, or scenarios that ship."""
    said = subprocess.run([program, "list", family], check=True, capture_output=True, text=True)
    return [line.split()[0] for line in said.stdout.splitlines()
            if line[:1] == " " and line[:3] != "   " and line.split()]


class Draw:
    """Settings of scenario number k, the same in every run."""

    def __init__(self, program):
        self.scenarios = names(program, "scenarios")
        self.behaviours = names(program, "behaviour")
        self.by_force = ("pair_forces", "virtual_potential")
        self.each_tick = (*self.by_force, "virtual_potential_step")
        self.solvers = ["newton", "nlopt.lbfgs", "nlopt.slsqp", "nlopt.bobyqa", "nlopt.neldermead"]

    def __call__(self, k):
        draw = random.Random(k)
        behaviour = draw.choice(self.behaviours)
        settings = {
            "behaviour.kind": behaviour,
            "guidance.kind": "conditioned_force" if behaviour in self.by_force else "drift",
            "waypoint.x_m": draw.uniform(-500, 500),
            "waypoint.y_m": draw.uniform(-500, 500),
            "trial.seed": draw.randrange(1, 10**6),
            "trial.duration_s": 120,
            "trial.record_every_s": 20,
            "ping.period_s": draw.choice([5, 10, 20]),
            "ping.range_sd_m": round(draw.uniform(0, 5), 3),
            "ping.bearing_sd_deg": round(draw.uniform(0, 10), 3),
            "planner.update":
                "tick" if behaviour in self.each_tick else draw.choice(["tick", "ping"]),
        }
        if behaviour in ("attraction_repulsion", "pairwise_referencing") and draw.random() < 0.7:
            settings[f"behaviour.{behaviour}.solver.kind"] = draw.choice(self.solvers)
        return draw.choice(self.scenarios), settings


def run(program, scenario, settings, folder):
    """What a run complained of, or nothing."""
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run([program, "run", scenario, "--no-report", "--out", folder, *words],
                          capture_output=True, text=True)
    return done.stderr if done.returncode != 0 else ""


def digest(folder):
    """Of all that a run recorded. netCDF is not for several threads."""
    bits = hashlib.sha256()
    for name in ("run.nc", "series.nc"):
        with netCDF4.Dataset(folder / name) as data:
            data.set_auto_mask(False)
            for variable in sorted(data.variables):
                bits.update(variable.encode() + data.variables[variable][:].tobytes())
    measures = json.loads((folder / "summary.json").read_text())["measures"]
    bits.update(json.dumps(measures).encode())
    return bits.hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs=2, metavar="program")
    parser.add_argument("--scenarios", type=int, default=200)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    arguments = parser.parse_args()
    programs = [os.path.abspath(program) for program in arguments.programs]
    draw = Draw(programs[0])
    which = range(arguments.first, arguments.first + arguments.scenarios)

    with tempfile.TemporaryDirectory() as name:
        def place(k, p):
            return pathlib.Path(name) / f"{k}_{p}"

        def both(k):
            return [run(program, *draw(k), place(k, p)) for p, program in enumerate(programs)]

        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            complaints = list(pool.map(both, which))
        results = [[(complaint, "" if complaint else digest(place(k, p)))
                    for p, complaint in enumerate(said)]
                   for k, said in zip(which, complaints)]
    differing = 0
    for k, said in zip(which, results):
        # Refusals name the files of the program, so that only their presence is compared.
        differs = said[0][1] != said[1][1]
        differing += differs
        if differs or said[0][0]:
            print(f"{k}: {'differs' if differs else 'refused'}: {draw(k)}")
            for complaint, bits in said:
                print("   ", bits or complaint.strip())
    ran = sum(not complaint for (complaint, _), _ in results)
    print(f"{len(results)} scenarios, {ran} ran, {len(results) - ran} were refused: {differing} differ")
    if ran < len(results) / 2:
        print("too few of them ran to say anything")
        return 1
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
