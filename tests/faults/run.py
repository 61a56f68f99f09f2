#!/usr/bin/env python3
"""Every call to the system fails once, and the power too: what is left can be carried on.

    tests/faults/run.py PROGRAM [--every K] [--jobs J] [--kinds KIND ...]

A small sweep and a run are repeated; in the n-th repetition the n-th call of one kind (open, read,
write, sync, rename, truncate, folder, memory) fails, or the process is killed at it and all that was
not synced is gone (power). Each time
  - the program ends by itself, within a minute, with 0, or with 1 or 2 and one line that says why
    (without memory, HDF5 crashes or exits, and parts of libstdc++ abort: that is allowed);
  - with 0, everything is there as if nothing had happened, or it says how many trials failed;
  - in any case the same command, given again without the fault (and with --retry-failed), ends well,
    with the same tables and the same run, bit for bit.
--every K takes every K-th call only: of memory, where there are 100,000, every 200 K-th.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

import netCDF4

HERE = pathlib.Path(__file__).resolve().parent
KINDS = ("open", "read", "write", "sync", "rename", "truncate", "folder", "memory", "power")
ENDED_BY_A_LIBRARY = (-signal.SIGABRT, -signal.SIGSEGV, 255)
STUDY = """scenario = "construction_square"
replications = 2
set = { trial.duration_s = 20 }
[[factor]]
key = "ping.period_s"
values = [5, 10]
"""


def built(folder):
    library = folder / "failing_calls.so"
    subprocess.run(["cc", "-std=c17", "-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-o",
                    library, HERE / "failing_calls.c"], check=True)
    return library


def sweep(place):
    (place / "study.toml").write_text(STUDY)
    return ["sweep", place / "study.toml", "--jobs", "1", "--no-figures",
            "--retry-failed", "--out", place / "out"]


def run(place):
    return ["run", "construction_square", "--set", "trial.duration_s=20", "--out", place / "out"]


def result(place):
    """What must be the same: all but times, paths and names of hosts."""
    files = {}
    for path in sorted((place / "out").rglob("*")):
        name = str(path.relative_to(place / "out"))
        if not path.is_file() or path.name.startswith((".lock", "trials.sqlite", "manifest")):
            continue
        content = path.read_bytes().replace(str(place).encode(), b"PLACE")
        if name == "summary.json":
            content = re.sub(rb'^ *"[a-z_]*wall_s".*$', b"", content, flags=re.MULTILINE)
        if name == "report.html":  # which holds times, too
            content = content[-20:]
        files[name] = content
    return files


NETCDF = threading.Lock()  # it is not for several threads


def numbers_of(content):
    """All that a netCDF file says, whatever its layout."""
    with NETCDF, netCDF4.Dataset("memory", memory=content) as data:
        data.set_auto_mask(False)
        return ({name: len(dimension) for name, dimension in data.dimensions.items()},
                {name: data.getncattr(name) for name in data.ncattrs()},
                {name: (variable.dimensions, variable[:].tobytes(),
                        [(a, str(variable.getncattr(a))) for a in variable.ncattrs()])
                 for name, variable in data.variables.items()})


def same(name, one, other):
    """Whether two files are: without memory, HDF5 may put the same numbers in another order."""
    if one == other or one is None or other is None or not name.endswith(".nc"):
        return one == other
    return numbers_of(one) == numbers_of(other)


def lose_power(place, synced):
    """Only what was synced is on disk, in files whose names are."""
    for path in (place / "out").rglob("*"):
        if path.is_file() and not path.is_symlink():
            kept = synced / str(path.stat().st_ino)
            path.write_bytes(kept.read_bytes() if kept.exists() else b"")


class Trials:
    """One command, again and again."""

    def __init__(self, program, library, folder, command):
        self.program, self.library, self.folder, self.command = program, library, folder, command
        counts = folder / f"{command.__name__}_counts"
        place = self.place("reference")
        done = self.call(place, {"SHOAL_FAULT_COUNTS": str(counts)})
        if done.returncode != 0:
            sys.exit("without a fault: " + done.stderr)
        self.expected = result(place)
        # A process, and those that it starts: the calls of the one that makes most.
        self.counts = {}
        for kind, number in re.findall(r"(\w+) (\d+)", counts.read_text()):
            self.counts[kind] = max(self.counts.get(kind, 0), int(number))

    def place(self, name):
        place = self.folder / f"{self.command.__name__}_{name}"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        return place

    def call(self, place, environment):
        preload = {"LD_PRELOAD": str(self.library)} if environment else {}
        return subprocess.run([self.program, *map(str, self.command(place))], timeout=60, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=place,
                              start_new_session=True, env={**os.environ, **preload, **environment})

    def fault(self, kind, n):
        """What is wrong after the n-th call of a kind failed; "" for nothing."""
        place = self.place(f"{kind}_{n}")
        synced = place / "synced"
        synced.mkdir()
        try:
            done = self.call(place, {"SHOAL_FAULT": f"{kind}:{n}", "SHOAL_FAULT_SYNCED": str(synced)})
        except subprocess.TimeoutExpired:
            return "does not end"
        if kind == "power":
            lose_power(place, synced)
        elif kind == "memory" and done.returncode in ENDED_BY_A_LIBRARY:
            pass
        elif done.returncode not in (0, 1, 2):
            return f"ends with {done.returncode}: {done.stderr[-500:]}"
        elif done.returncode != 0 and not re.search(r"^shoal: .+$", done.stderr, re.MULTILINE):
            return f"does not say why: {done.stderr[-500:]}"
        elif (done.returncode == 0 and self.differences(place)
              and " failed; the first: " not in done.stdout):
            return f"ends well with another result in {self.differences(place)}: {done.stderr[-300:]}"
        left = [str(p) for p in place.rglob("*.partial")] if kind != "power" else []
        if left:
            return f"leaves {left[0]}"
        try:
            again = self.call(place, {})
        except subprocess.TimeoutExpired:
            return "afterwards it does not end"
        if again.returncode != 0:
            return f"afterwards it fails: {again.stderr[-500:]}"
        if self.differences(place):
            return f"afterwards the result differs in {self.differences(place)}"
        shutil.rmtree(place)
        return ""

    def differences(self, place):
        got = result(place)
        return ", ".join(sorted(name for name in got.keys() | self.expected.keys()
                                if not same(name, got.get(name), self.expected.get(name))))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--every", type=int, default=1, metavar="K")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    faults = 0
    with tempfile.TemporaryDirectory() as name, \
            concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        folder = pathlib.Path(name)
        library = built(folder)
        for trials in [Trials(program, library, folder, command) for command in (sweep, run)]:
            for kind in arguments.kinds:
                calls = range(1, trials.counts[kind] + 1,
                              arguments.every * (200 if kind == "memory" else 1))
                wrong = list(pool.map(lambda n: trials.fault(kind, n), calls))
                print(f"{trials.command.__name__}: {len(calls)} of {trials.counts[kind]} calls "
                      f"({kind}), faults: {sum(map(bool, wrong))}", flush=True)
                for n, what in zip(calls, wrong):
                    if what:
                        faults += 1
                        print(f"  {kind}:{n} {what}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
