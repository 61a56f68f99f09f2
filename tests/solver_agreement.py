#!/usr/bin/env python3
"""One swarm, one seed, another solver: what changes in energy and quality.

    tests/solver_agreement.py [--shoal PROGRAM] [--seeds N] [--duration S] [--solvers A B ...]

Every solver flies the hexagonal lattice of the attraction/repulsion behaviour from the same starts,
noise and currents. Where solvers find the same minima, the means agree but for the chaos of a swarm:
a mean further from that of the first solver than four standard errors of the difference is an error.
"""

import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENARIOS = ["construction_hexagonal", "redsea_hexagonal"]
SOLVERS = ["newton", "nlopt.lbfgs", "nlopt.slsqp", "nlopt.tnewton", "nlopt.var2", "nlopt.bobyqa",
           "nlopt.neldermead", "ceres.lbfgs"]
MEASURES = {"energy_mean_wh": "energy, Wh", "quality_settled_m": "quality, m"}


def run(arguments, scenario, solver, seed):
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([arguments.shoal, "run", scenario, "--seed", str(seed), "--out", out,
                        "--set", "behaviour.kind=attraction_repulsion",
                        "--set", f"behaviour.attraction_repulsion.solver.kind={solver}",
                        "--set", f"trial.duration_s={arguments.duration}",
                        "--set", "trial.record_every_s=0"], check=True, stdout=subprocess.DEVNULL)
        metrics = json.loads((pathlib.Path(out) / "summary.json").read_text())["metrics"]
    return [metrics[name] for name in MEASURES]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    top = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--shoal", default=str(top / "build/release/bin/shoal"))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--duration", type=int, default=7200)
    parser.add_argument("--solvers", nargs="+", default=SOLVERS)
    arguments = parser.parse_args()

    seeds = range(1, arguments.seeds + 1)
    apart = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for scenario in SCENARIOS:
            jobs = {solver: [pool.submit(run, arguments, scenario, solver, seed) for seed in seeds]
                    for solver in arguments.solvers}
            print(f"{scenario}, {arguments.duration} s, mean +- standard deviation of "
                  f"{arguments.seeds} seeds")
            print(f"  {'solver':<18}" + "".join(f"{title:>20}" for title in MEASURES.values()))
            known = None
            for solver, trials in jobs.items():
                columns = list(zip(*(trial.result() for trial in trials)))
                values = [(statistics.mean(c), statistics.stdev(c)) for c in columns]
                known = known or values
                marks = ""
                for (mean, sd), (first, sd_first) in zip(values, known):
                    error = math.hypot(sd, sd_first) / math.sqrt(arguments.seeds)
                    if abs(mean - first) > 4 * error:
                        marks += " *"
                apart += bool(marks)
                print(f"  {solver:<18}" +
                      "".join(f"{f'{m:.1f} +- {s:.1f}':>20}" for m, s in values) + marks)
            print()
    if apart:
        print(f"{apart} rows marked * differ from {arguments.solvers[0]} by more than four standard "
              "errors")
    return 1 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
