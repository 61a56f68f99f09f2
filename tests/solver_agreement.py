#!/usr/bin/env python3
"""One swarm, one seed, another solver: what changes in energy and quality.

    tests/solver_agreement.py [--shoal PROGRAM] [--seeds N] [--duration S] [--solvers A B ...]

Every solver flies the hexagonal lattice of the attraction/repulsion behaviour from the same starts,
noise and currents. Where solvers find the same minima, they agree but for the chaos of a swarm: trials of
a seed are compared with those of the first solver in pairs, by the t test of their differences, with
Holm's correction for all rows that are printed. What is significant at 1 % is an error.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from scipy import stats

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
        measures = json.loads((pathlib.Path(out) / "summary.json").read_text())["measures"]
    return [measures[name] for name in MEASURES]


def paired_p(values, reference):
    """Two-sided p of the t test of paired differences; 1 where there are none."""
    if values == reference:
        return 1.0
    return stats.ttest_rel(values, reference).pvalue


def significant(p_values, level):
    """Keys of the hypotheses that Holm 1979 rejects."""
    rejected = []
    for rank, (key, p) in enumerate(sorted(p_values.items(), key=lambda item: item[1])):
        if p > level / (len(p_values) - rank):
            break
        rejected.append(key)
    return rejected


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    top = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--shoal", default=str(top / "build/release/bin/shoal"))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--duration", type=int, default=7200)
    parser.add_argument("--solvers", nargs="+", default=SOLVERS)
    arguments = parser.parse_args()

    seeds = range(1, arguments.seeds + 1)
    rows = {}  # (scenario, solver) -> per measure, its value for each seed
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {(scenario, solver): [pool.submit(run, arguments, scenario, solver, seed)
                                     for seed in seeds]
                for scenario in SCENARIOS for solver in arguments.solvers}
        for row, trials in jobs.items():
            rows[row] = list(zip(*(trial.result() for trial in trials)))
    p_values = {(row, k): paired_p(rows[row][k], rows[row[0], arguments.solvers[0]][k])
                for row in rows if row[1] != arguments.solvers[0] for k in range(len(MEASURES))}
    apart = {row for row, _ in significant(p_values, 0.01)}

    for scenario in SCENARIOS:
        print(f"{scenario}, {arguments.duration} s, mean +- standard deviation of "
              f"{arguments.seeds} seeds")
        print(f"  {'solver':<18}" + "".join(f"{title:>20}" for title in MEASURES.values()))
        for solver in arguments.solvers:
            cells = (f"{statistics.mean(c):.1f} +- {statistics.stdev(c):.1f}"
                     for c in rows[scenario, solver])
            print(f"  {solver:<18}" + "".join(f"{cell:>20}" for cell in cells) +
                  (" *" if (scenario, solver) in apart else ""))
        print()
    if apart:
        print(f"{len(apart)} rows marked * differ from {arguments.solvers[0]}, seed by seed")
    return 1 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
