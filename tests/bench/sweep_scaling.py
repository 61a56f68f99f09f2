"""How much faster a sweep of equal trials is with more jobs. Nothing else should run meanwhile.

    python3 tests/bench/sweep_scaling.py --shoal build/release/bin/shoal [--jobs 1 2] [--repeat 3]
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

STUDY = """title = "equal trials"
scenario = "construction_square"
replications = {trials}
set = {{ trial.duration_s = {duration} }}
"""


def wall_s(shoal, study, jobs):
    """Of the trials alone, as the manifest tells it: neither start-up nor tables."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([shoal, "sweep", study, "--out", folder, "--jobs", str(jobs)], check=True,
                       stdout=subprocess.DEVNULL)
        manifest = json.loads((pathlib.Path(folder) / "manifest.json").read_text())
        return manifest["sweeps"][-1]["wall_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--shoal", required=True)
    parser.add_argument("--jobs", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--trials", type=int, default=48)
    parser.add_argument("--duration", type=int, default=3600, help="s simulated in each trial")
    parser.add_argument("--repeat", type=int, default=3, help="sweeps of each; the fastest counts")
    options = parser.parse_args()
    print(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.2f} before the first sweep")
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(STUDY.format(trials=options.trials, duration=options.duration))
        first = None
        for jobs in options.jobs:
            best = min(wall_s(options.shoal, study, jobs) for _ in range(options.repeat))
            first = first or best
            print(f"{jobs:3} jobs  {best:8.2f} s  {first / best:5.2f} times as fast as "
                  f"{options.jobs[0]}", flush=True)


if __name__ == "__main__":
    main()
