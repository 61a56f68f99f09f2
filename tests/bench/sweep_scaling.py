"""How much faster a sweep of equal trials is with more jobs. Nothing else should run meanwhile.

    python3 tests/bench/sweep_scaling.py --shoal build/release/bin/shoal [--jobs 1 2] [--repeat 3]

Beside the threads of one sweep stand as many processes, each with a part of the same study.
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


def sweep(shoal, study, folder, *arguments):
    return subprocess.Popen([shoal, "sweep", study, "--out", folder, *arguments],
                            stdout=subprocess.DEVNULL)


def wall_s(folder):
    """Of the trials alone, as the manifest tells it: neither start-up nor tables."""
    manifest = json.loads((pathlib.Path(folder) / "manifest.json").read_text())
    return manifest["sweeps"][-1]["wall_s"]


def with_threads(shoal, study, jobs):
    with tempfile.TemporaryDirectory() as folder:
        if sweep(shoal, study, folder, "--jobs", str(jobs)).wait() != 0:
            raise SystemExit("the sweep failed")
        return wall_s(folder)


def with_processes(shoal, study, jobs):
    """Parts of the study that share nothing but the machine: what it gives at best."""
    with tempfile.TemporaryDirectory() as folder:
        places = [f"{folder}/{part}" for part in range(1, jobs + 1)]
        running = [sweep(shoal, study, place, "--jobs", "1", "--shard", f"{part}/{jobs}")
                   for part, place in enumerate(places, 1)]
        if any(each.wait() != 0 for each in running):
            raise SystemExit("a sweep failed")
        return max(map(wall_s, places))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--shoal", required=True)
    parser.add_argument("--jobs", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--duration", type=int, default=7200, help="s simulated in each trial")
    parser.add_argument("--repeat", type=int, default=3, help="sweeps of each; the fastest counts")
    options = parser.parse_args()
    print(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.2f} before the first sweep")
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(STUDY.format(trials=options.trials, duration=options.duration))
        first = None
        for jobs in options.jobs:
            for how, run in [("threads", with_threads), ("processes of one", with_processes)]:
                if jobs == 1 and run is with_processes:
                    continue
                best = min(run(options.shoal, study, jobs) for _ in range(options.repeat))
                first = first or best
                print(f"{jobs:3} {how:16} {best:8.2f} s  {first / best:5.2f} times as fast as the "
                      "first", flush=True)


if __name__ == "__main__":
    main()
