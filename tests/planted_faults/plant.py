#!/usr/bin/env python3
"""Plants the faults of faults.toml one at a time: do the tests catch them?

    tests/planted_faults/plant.py [--only N ...] [--results FILE] [--work DIR] [--build DIR] [--all]
    tests/planted_faults/plant.py --list

Works on a copy of the sources, which it builds and tests as they are first. Then it changes one file at a
time, builds the library that the file belongs to (all are shared: only tests that include the file are
built anew), and runs the tests of that layer and of those above it until one fails. A test program that
does not end within five minutes has caught the fault, too.

Each answer is written to --results at once, and a run that was interrupted goes on where it stopped; after
a change of sources or tests, delete that file. --work keeps the copy and its build for the next run.
--all runs tests written in Python as well, where the others find nothing: slow, and not needed. Ends with 1
if fewer than 95 % of the faults were caught. A fault that does not build is an error of the list.
"""

import argparse
import collections
import csv
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
LIST = HERE / "faults.toml"
LAYERS = ["core", "solvers", "formations", "scenarios", "analysis"]  # from below
NOT_COPIED = {".git", "build", "out", "node_modules", "__pycache__"}
TIMEOUT_S = 300
WANTED = 0.95
COLUMNS = ["number", "file", "kind", "caught by", "seconds", "key"]
NOT_CAUGHT = "not caught"
NOT_CAUGHT_BY_ALL = "not caught, nor by tests in Python"
ERROR = "error: "
FAILED_TEST = re.compile(r"^\[  FAILED  \] ([\w./]+)", re.MULTILINE)


def listed_faults():
    """{number: fault}, from 1 on."""
    with LIST.open("rb") as file:
        return dict(enumerate(tomllib.load(file)["fault"], 1))


def layer_of(fault):
    return fault["file"].split("/")[0]


def targets_of(fault):
    """What is built with the fault: the library, and of a header what may have it in its own code."""
    layer = layer_of(fault)
    tests = LAYERS[LAYERS.index(layer):] if fault["file"].endswith(".hpp") else []
    return {f"shoal_{layer}", *(f"{each}_test" for each in tests)}


def key_of(fault):
    """Changes with the fault, so that an answer for another one of its number is not taken for it."""
    text = "\0".join([fault["file"], fault["is"], fault["becomes"]])
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def files_in(folder, left_out):
    """Paths in the folder, relative to it."""
    for base, folders, names in os.walk(folder):
        folders[:] = [f for f in folders if f not in NOT_COPIED and pathlib.Path(base, f) != left_out]
        for name in names:
            yield pathlib.Path(base, name).relative_to(folder)


def same_content(one, other):
    return other.is_file() and one.read_bytes() == other.read_bytes()


def synchronise(source, copy):
    """Makes `copy` like `source`, and leaves alone what is: its date decides what is compiled."""
    wanted = set(files_in(source, left_out=copy.parent))
    for path in sorted(wanted):
        if not same_content(source / path, copy / path):
            (copy / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / path, copy / path)
        shutil.copymode(source / path, copy / path)
    if copy.exists():
        for path in set(files_in(copy, left_out=None)) - wanted:
            (copy / path).unlink()


class Copy:
    """The sources to plant faults in, and their build."""

    def __init__(self, work, build, with_python):
        self.source = work / "source"
        self.build = build or self.source / "build" / "ci"
        self.with_python = with_python
        self.stale = set()  # targets that still have the last fault in them

    def prepare(self):
        """Builds everything, and ends the program if a test fails without a fault."""
        synchronise(TOP, self.source)
        print(f"building the unchanged sources in {self.build}", flush=True)
        configure = ["cmake", "--preset", "ci", "-B", str(self.build), "-DSHOAL_PYTHON=OFF",
                     "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON"]
        done = subprocess.run(configure, cwd=self.source, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        targets = [f"{layer}_test" for layer in LAYERS] + ["shoal_library"]
        if self.with_python:
            targets += ["shoal_program", "statistics_answers"]
        if complaint := self.make(targets):
            sys.exit(complaint)
        failed = self.failed_test(LAYERS)
        if not failed and self.with_python:
            failed = self.failed_python_test("scenarios") or self.failed_python_test("analysis")
        if failed:
            sys.exit(f"this fails without any fault: {failed}")

    def make(self, targets):
        """What the build says if it fails, else nothing."""
        done = subprocess.run(["cmake", "--build", str(self.build), "--target", *targets],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.stdout if done.returncode != 0 else None

    def answer(self, fault):
        """What catches the fault: plants it, builds, tests, and takes it out again."""
        path = self.source / fault["file"]
        sound = path.read_bytes()
        found = sound.count(fault["is"].encode())
        if found != 1:
            return f"{ERROR}its text is there {found} times"
        layer = layer_of(fault)
        try:
            path.write_bytes(sound.replace(fault["is"].encode(), fault["becomes"].encode()))
            complaint = self.make(sorted(self.stale | targets_of(fault)))
            if complaint:
                first = next((line for line in complaint.splitlines() if "error:" in line), "")
                return f"{ERROR}does not build: {first}"
            failed = self.failed_test(LAYERS[LAYERS.index(layer):])
            if failed or not self.with_python:
                return failed or NOT_CAUGHT
            return self.failed_python_test(layer) or NOT_CAUGHT_BY_ALL
        finally:
            path.write_bytes(sound)  # as new as can be, so that it is compiled again
            self.stale = targets_of(fault)

    def failed_test(self, layers):
        """The first test of these layers that fails, or nothing."""
        for layer in layers:
            program = self.build / "bin" / f"{layer}_test"
            if failed := self.failure([program, "--gtest_brief=1", "--gtest_fail_fast"]):
                return f"{program.name}: {failed}"
        return None

    def failed_python_test(self, layer):
        tests, programs = self.source / "tests", self.build / "bin"
        if layer == "analysis":
            command = [tests / "analysis" / "statistics_test.py", programs / "statistics_answers"]
        else:
            command = [tests / "golden.py", "--shoal", programs / "shoal"]
        failed = self.failure([sys.executable, *command], 4 * TIMEOUT_S)
        return f"{command[0].name}: {failed}" if failed else None

    def failure(self, command, timeout_s=TIMEOUT_S):
        """How the program fails, or nothing if it does not."""
        environment = os.environ | {"RC_PARAMS": "seed=1 max_success=20"}
        environment.setdefault("SHOAL_SHARED", str(TOP.parent / "shared"))
        process = subprocess.Popen([str(part) for part in command], cwd=self.build, env=environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   errors="replace", start_new_session=True)
        try:
            output, _ = process.communicate(timeout=timeout_s)
        except subprocess.TimeoutExpired:
            return f"no end within {timeout_s} s"
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)  # and all that it started
                process.communicate()
        if process.returncode == 0:
            return None
        test = FAILED_TEST.search(output)
        return test[1] if test else f"ended with {process.returncode}"


def earlier_rows(results, faults):
    """{number: row} of what is known of these faults; a later row stands for those before."""
    if not results.exists():
        return {}
    with results.open(newline="") as file:
        rows = {int(row["number"]): row for row in csv.DictReader(file)}
    return {n: row for n, row in rows.items() if n in faults and row["key"] == key_of(faults[n])}


def is_open(row, with_python):
    """Whether there is still something to find out."""
    if row is None or row["caught by"].startswith(ERROR):
        return True
    return with_python and row["caught by"] == NOT_CAUGHT


def append(results, row):
    is_new = not results.exists()
    results.parent.mkdir(parents=True, exist_ok=True)
    with results.open("a", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        if is_new:
            writer.writeheader()
        writer.writerow(row)


def is_caught(row):
    return not row["caught by"].startswith((NOT_CAUGHT, ERROR))


def report(faults, rows):
    """Prints what was missed, and counts by folder; 1 if that is too much."""
    print()
    for number, row in rows.items():
        if not is_caught(row):
            fault = faults[number]
            print(f"{number} {fault['file']}: {row['caught by']}\n    {fault['about']}")
    counts = collections.defaultdict(lambda: [0, 0])
    for number, row in rows.items():
        for folder in (layer_of(faults[number]), "all"):
            counts[folder][0] += is_caught(row)
            counts[folder][1] += 1
    caught, planted = counts.pop("all")
    for folder, (some, of) in counts.items():
        print(f"{folder:<12} {some:>3} of {of:>3} caught")
    print(f"{'all':<12} {caught:>3} of {planted:>3} caught")
    return 1 if caught < WANTED * planted else 0


def arguments(faults):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", type=int, nargs="+", metavar="N", choices=list(faults),
                        help="numbers of faults, as --list shows them")
    parser.add_argument("--list", action="store_true", help="show the faults, and plant none")
    parser.add_argument("--results", type=pathlib.Path, metavar="FILE",
                        default=TOP / "build" / "planted_faults.csv", help="CSV file; default: %(default)s")
    parser.add_argument("--work", type=pathlib.Path, metavar="DIR",
                        help="folder of the copy, which is kept; default: a temporary one")
    parser.add_argument("--build", type=pathlib.Path, metavar="DIR",
                        help="folder of its build; default: build/ci of the copy")
    parser.add_argument("--all", action="store_true", help="as a last resort, tests in Python as well")
    return parser.parse_args()


def main():
    faults = listed_faults()
    given = arguments(faults)
    chosen = {n: faults[n] for n in given.only} if given.only else faults
    if given.list:
        for number, fault in chosen.items():
            print(f"{number:>3} {fault['file']} ({fault['kind']})\n    {fault['about']}")
        return 0

    rows = {n: row for n, row in earlier_rows(given.results, faults).items() if n in chosen}
    open_ones = [n for n in chosen if is_open(rows.get(n), given.all)]
    if open_ones:
        with tempfile.TemporaryDirectory() as temporary:
            work = (given.work or pathlib.Path(temporary)).resolve()
            copy = Copy(work, given.build and given.build.resolve(), given.all)
            copy.prepare()
            for number in open_ones:
                fault = faults[number]
                begin = time.monotonic()
                answer = copy.answer(fault)
                row = {"number": number, "file": fault["file"], "kind": fault["kind"],
                       "caught by": answer, "seconds": round(time.monotonic() - begin),
                       "key": key_of(fault)}
                append(given.results, row)
                rows[number] = row
                print(f"{number:>3} {fault['file']} ({fault['kind']}): {answer}", flush=True)
    return report(faults, {n: rows[n] for n in chosen})


if __name__ == "__main__":
    sys.exit(main())
