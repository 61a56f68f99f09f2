#!/usr/bin/env python3
"""tests/lint.py BUILD_DIR...: clang-format and clang-tidy on all sources.

Sources that a unity build compiles as one are read as one, which takes a quarter of the time; give
such a build first, and then others for what it leaves out. What clang-tidy found clean is not read
again while neither it nor what it includes, its compile command or the checks have changed: the key
of all that is kept in the user's cache, which any clone may use. Delete ~/.cache/shoal/clang-tidy to
begin anew.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
CACHE_HOME = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
CACHE = CACHE_HOME / "shoal" / "clang-tidy"
LINTED = ["core", "solvers", "formations", "scenarios", "analysis"]


def files(folders, *endings):
    found = [p for folder in folders for p in (TOP / folder).rglob("*") if p.suffix in endings]
    return sorted(found)


def check_format():
    sources = files(LINTED + ["tests"], ".cpp", ".hpp")
    done = subprocess.run(["clang-format", "--dry-run", "--Werror", *map(str, sources)])
    if done.returncode != 0:
        sys.exit("lint: clang-format -i would change these files")


def included_files(build):
    """What each object was compiled from, as ninja knows it: {object: [file]}."""
    text = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True, text=True).stdout
    included, current = {}, None
    for line in text.splitlines():
        if line.startswith("    "):
            included[current].append(line.strip())
        elif line:
            current = line.split(":", 1)[0]
            included[current] = []
    return included


def object_of(command):
    return re.search(r" -o (\S+) ", command["command"]).group(1)


def key_of(command, included, build, checks):
    digest = hashlib.sha256(checks)
    digest.update(command["command"].replace(str(TOP), "").encode())
    for name in sorted(included):
        path = pathlib.Path(build, name).resolve()
        inside = path.is_relative_to(TOP)
        digest.update(str(path.relative_to(TOP) if inside else path).encode())
        if inside:
            digest.update(path.read_bytes().replace(str(TOP).encode(), b""))
        else:
            digest.update(str(path.stat().st_mtime_ns).encode())
    return digest.hexdigest()


def tidy(source, build):
    done = subprocess.run(
        ["clang-tidy", "-p", build, "--quiet", "--checks=-bugprone-suspicious-include",
         "--extra-arg=-Wno-unknown-warning-option", source],
        capture_output=True, text=True)
    complaints = "\n".join(l for l in done.stderr.splitlines() if not re.search(r"warnings? .*generated", l))
    return done.returncode, done.stdout + complaints


def sources_of(compiled):
    """What a compiled file consists of: itself, or the sources that a unity build put into it."""
    if "/Unity/" not in compiled:
        return {compiled}
    return set(re.findall(r'^#include "(.+)"', pathlib.Path(compiled).read_text(), re.MULTILINE))


def check_tidy(builds):
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout
    checks = version + (TOP / ".clang-tidy").read_bytes()
    CACHE.mkdir(parents=True, exist_ok=True)

    left = {str(s) for s in files(LINTED, ".cpp")}
    waiting, read = [], 0
    for build in builds:
        included = included_files(build)
        for command in json.loads(pathlib.Path(build, "compile_commands.json").read_text()):
            wanted = sources_of(command["file"]) & left
            if not wanted:
                continue
            left -= wanted
            read += 1
            built_from = included.get(object_of(command))
            key = key_of(command, built_from, build, checks) if built_from else None
            if key is None or not (CACHE / key).exists():
                waiting.append((command["file"], build, key))
    # Stands in for a source of a backend that is left out: compiled by tests/install/smallest.sh only.
    left = {name for name in left if not name.endswith("_left_out.cpp")}
    if left:
        sys.exit(f"lint: not compiled, so not checked: {', '.join(sorted(left))}")
    print(f"clang-tidy: {read} compiled files, {read - len(waiting)} known to be clean", flush=True)

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        work = {pool.submit(tidy, source, build): key for source, build, key in waiting}
        for done in concurrent.futures.as_completed(work):
            status, text = done.result()
            if text:
                print(text, flush=True)
            if status != 0:
                failed += 1
            elif work[done]:
                (CACHE / work[done]).touch()
    if failed:
        sys.exit(f"lint: {failed} files have complaints")


check_format()
check_tidy([str(pathlib.Path(build).resolve()) for build in sys.argv[1:]])
