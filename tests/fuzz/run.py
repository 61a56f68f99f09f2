#!/usr/bin/env python3
"""Mutated input files for every reader: a fuzz test.

    tests/fuzz/run.py BUILD_DIR [TARGET ...] [--runs N] [--seconds S] [--jobs J] [--keep FOLDER]

BUILD_DIR is a build of the preset asan. Each target begins with what the project itself reads and
writes, and with the inputs in tests/fuzz/seeds that were answered wrongly once; then it changes them.
A crash, a finding of a sanitizer, ten seconds or a gigabyte for one input, and an answer that is no
sentence are faults: the input is kept in the folder, and the exit status is 1.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
TARGETS = sorted(path.name.removesuffix("_fuzz.cpp") for path in HERE.glob("*_fuzz.cpp"))
# Read by netCDF and HDF5, which forget memory of files that are damaged.
FOREIGN = ("current", "run")
# The most bytes of inputs; elsewhere, those of the longest seed and 500 more.
LONGEST = {"formula": 200, "set": 400, "eval": 2000, "plan": 2000}


def shipped_texts(target):
    """Files of the project that a target reads."""
    library = TOP / "scenarios" / "library"
    studies = TOP / "analysis" / "studies"
    if target == "scenario":
        return sorted(library.rglob("*.toml"))
    if target == "study":
        return [path for path in sorted(studies.glob("*.toml")) if not path.stem.endswith("_claims")]
    if target == "claims":
        return sorted(studies.glob("*_claims.toml"))
    return []


def small_lines(target):
    """Inputs that are lines of text."""
    return {
        "formula": ["s / r - 1", "(s/r)^2 + exp(-r/s) * sin(pi*r)", "min(r, s) + max(r, 2) ^ 0.5",
                    "atan(sqrt(abs(r - s))) - cosh(r/s)", "pow(r/s, 3) - log(r)"],
        "set": ["behaviour.kind=rigid_registration", "swarm.vehicle={kind=\"drifter\"}",
                "obstacle=[{shape={kind=\"circle\"}}]", "trial.duration_s=1e3",
                "plan.square.rows = 3", "planner.update=\"tick\""],
        "plan": ["name,x_m,y_m\na,0,0\nb,150,0\n", "\ufeffname,x_m,y_m\r\n\"a,1\",-1e3,0\r\n# b\r\nc,1,2\r\n"],
        "eval": [chr(k) + text for k in range(6) for text in
                 ["x_m,y_m\n1,2\n", "fx,fy\n1,2\n3,4\n", "surge_m_s,sway_m_s\n1,0\n"]],
        "corpus": ["{\"experiment\": {}}\n", "{\"situation\": 0}\n"],
    }.get(target, [])


QUIET = {**os.environ, "LSAN_OPTIONS": "print_suppressions=0"}


def run_shoal(program, *arguments):
    subprocess.run([program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, env=QUIET)


def recorded(program, folder):
    """What shoal writes itself, small: {target: [file]}."""
    short = ["--set", "trial.duration_s=20", "--set", "trial.record_every_s=10"]
    run_shoal(program, "run", "construction_square", "--out", folder / "run", "--record-problems",
              folder / "problems.jsonl", *short)
    study = folder / "study.toml"
    study.write_text('scenario = "construction_square"\nset = { trial.duration_s = 20 }\n'
                     '[[factor]]\nkey = "ping.period_s"\nvalues = [5, 10]\n')
    run_shoal(program, "sweep", study, "--jobs", "1", "--out", folder / "study")
    lines = (folder / "problems.jsonl").read_text().splitlines()
    some = folder / "some.jsonl"
    some.write_text("\n".join(lines[:4]) + "\n")
    return {"run": [folder / "run" / "run.nc"], "store": [folder / "study" / "trials.sqlite"],
            "scenario": [folder / "run" / "scenario.toml"], "corpus": [some],
            "study": [folder / "study" / "study.toml"]}


def currents(folder):
    """Small files of currents: netCDF-4 and classic, with levels and packed numbers."""
    import netCDF4
    files = []
    for k, kind in enumerate(["NETCDF4", "NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET"]):
        files.append(folder / f"current_{k}.nc")
        with netCDF4.Dataset(files[-1], "w", format=kind) as data:
            for name, unit, standard_name, values in [
                    ("time", "hours since 2020-01-01", "time", [0, 6]),
                    ("depth", "m", "depth", [0, 50]),
                    ("lat", "degrees_north", "latitude", [20, 20.1, 20.2]),
                    ("lon", "degrees_east", "longitude", [38, 38.1, 38.2])]:
                data.createDimension(name, len(values))
                axis = data.createVariable(name, "f8", (name,))
                axis.units, axis.standard_name = unit, standard_name
                axis[:] = values
            for name, standard_name in [("u", "eastward_sea_water_velocity"),
                                        ("v", "northward_sea_water_velocity")]:
                flow = data.createVariable(name, "i2", ("time", "depth", "lat", "lon"),
                                           zlib=kind == "NETCDF4", fill_value=-999)
                flow.units, flow.standard_name, flow.scale_factor = "m s-1", standard_name, 0.001
                flow[:] = 0.1
    return {"current": files}


def seeds_of(target, made, folder):
    place = folder / "seeds" / target
    place.mkdir(parents=True)
    inputs = [path.read_bytes() for path in shipped_texts(target) + made.get(target, [])]
    inputs += [text.encode() for text in small_lines(target)]
    inputs += [path.read_bytes() for path in sorted((HERE / "seeds" / target).glob("*"))]
    for k, content in enumerate(inputs):
        (place / f"{k:03}").write_bytes(content)
    return place, max(map(len, inputs))


def fuzz(target, arguments, made, folder):
    """Runs one target; its report, and whether it found no fault."""
    seeds, longest = seeds_of(target, made, folder)
    new = folder / "new" / target
    new.mkdir(parents=True)
    kept = pathlib.Path(arguments.keep or folder) / target
    kept.mkdir(parents=True, exist_ok=True)
    command = [os.path.join(arguments.build, "bin", target + "_fuzz"), "-seed=1", "-timeout=10",
               "-rss_limit_mb=3000", "-malloc_limit_mb=1000", "-verbosity=0",
               "-print_final_stats=1", "-close_fd_mask=1", f"-artifact_prefix={kept}/",
               f"-max_len={LONGEST.get(target, longest + 500)}"]
    command += [f"-runs={arguments.runs}"] if arguments.runs else []
    command += [f"-max_total_time={arguments.seconds}"] if arguments.seconds else []
    # A child that crashes in a foreign library would wait for its stack to be read, without using the
    # processor, and be taken for one that is blocked.
    own = int(target not in FOREIGN)
    environment = dict(QUIET, TMPDIR=str(folder), UBSAN_OPTIONS="print_stacktrace=1",
                       ASAN_OPTIONS=f"detect_leaks={own}:symbolize={own}")
    done = subprocess.run([*command, new, seeds], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          env=environment)
    if done.returncode == 0:  # also what a child crashed at is kept
        shutil.rmtree(kept)
    said = done.stderr.decode(errors="replace")
    runs = re.search(r"number_of_executed_units:\s+(\d+)", said)
    peak = re.search(r"peak_rss_mb:\s+(\d+)", said)
    line = (f"{target:10} {runs[1] if runs else '?':>9} inputs, at most {peak[1] if peak else '?'} MB: "
            f"{'no fault' if done.returncode == 0 else 'a fault, kept in ' + str(kept)}")
    return done.returncode == 0, line + ("" if done.returncode == 0 else "\n" + said[-6000:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("targets", nargs="*", metavar="target", help=", ".join(TARGETS))
    parser.add_argument("--runs", type=int, default=0, help="inputs a target")
    parser.add_argument("--seconds", type=int, default=0, help="most time a target")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--keep", help="folder for inputs that are faults")
    arguments = parser.parse_args()
    unknown = set(arguments.targets) - set(TARGETS)
    if unknown:
        parser.error(f"there is no target {unknown.pop()}; there are {', '.join(TARGETS)}")
    if not arguments.runs and not arguments.seconds:
        parser.error("give --runs or --seconds")
    if not arguments.keep:
        arguments.keep = tempfile.mkdtemp(prefix="shoal_faults_")
    with tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None) as name:
        folder = pathlib.Path(name)
        made = recorded(os.path.join(arguments.build, "bin", "shoal"), folder) | currents(folder)
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            results = list(pool.map(lambda target: fuzz(target, arguments, made, folder),
                                    arguments.targets or TARGETS))
    for _, line in results:
        print(line)
    return 0 if all(good for good, _ in results) else 1


if __name__ == "__main__":
    sys.exit(main())
