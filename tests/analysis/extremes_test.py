#!/usr/bin/env python3
"""Every option of a scenario at its extremes: the program runs, or refuses in one line; it neither
crashes nor hangs, and stays below a limit of memory.

    python3 extremes_test.py SHOAL [--all]        (--all: every value of every option, some minutes)
"""

import concurrent.futures
import os
import re
import resource
import subprocess
import sys

import desk
from desk import Desk

SMALL = """[trial]
duration_s = 2
[swarm]
start.box.side_m = 100
[plan]
square = { rows = 2, columns = 2, separation_m = 300 }
[quality]
every_s = 1
"""
MEMORY = 2 << 30  # bytes of addresses
SECONDS = 60
HUGE = ["nan", "inf", "-inf", "1e308", "-1e308", "1e-308", "0", "-1", "9223372036854775807", '""', "[]"]
# How long a mission lasts is for its author to say: that of 1e308 s does not end.
ENDLESS = {"trial.duration_s"}
ALL = "--all" in sys.argv
if ALL:
    sys.argv.remove("--all")


class Describe:
    """Options by key, with the choices that have to be made for each, as `shoal describe` prints them."""

    ENTRY = re.compile(r"^(\S+)\n    .*\n    takes (.*); default (.*)$", re.MULTILINE)
    CHOICE = re.compile(r"^(\S+)\.kind\n    .*; one of\n((?:      .*\n?)+)", re.MULTILINE)

    def __init__(self, say):
        self.say = say
        self.options = {}
        self.seen = set()
        known = re.search(r"known are (.*)$", say("describe", "no_such.option")).group(1)
        for name in re.split(r", | and ", known):
            if name != "inherits":
                self.take(name, {})

    def take(self, key, choices):
        text = self.say("describe", key)
        # A name may stand for members of families, too: what is meant begins with the key.
        for name, takes, _ in self.ENTRY.findall(text):
            if name.startswith(key + ".") or name == key:
                self.options.setdefault(name, (takes, choices))
        for name, members in self.CHOICE.findall(text):
            if not name.startswith(key):
                continue
            for member in (line.split()[0] for line in members.splitlines()):
                if (name.rpartition(".")[2], member) in self.seen:
                    continue  # members may choose from their own family
                self.seen.add((name.rpartition(".")[2], member))
                self.options.setdefault(f"{name}.kind", ("a kind", choices))
                self.take(f"{name}.{member}", {**choices, f"{name}.kind": member})


def extremes(takes):
    bounds = re.search(r"(?:from|at least|above) (\S+)(?: to (\S+)| and at most (\S+))?", takes)
    ends = [end for end in (bounds.groups() if bounds else ()) if end]
    return [*dict.fromkeys([*ends, *HUGE])]


class Extremes(Desk):
    def say(self, *words):
        done = self.shoal(*words)
        return done.stdout + done.stderr

    def outcome(self, key, value, choices, number):
        """What is wrong with the end of a run, or nothing."""
        words = [word for each, kind in choices.items() for word in ("--set", f"{each}={kind}")]
        folder = self.desk / str(number)
        folder.mkdir()
        command = [desk.SHOAL, "check" if key in ENDLESS else "run", str(self.desk / "small.toml")]
        if key not in ENDLESS:
            command += [*words, "--set", f"{key}={value}", "--no-report", "--out", "out"]
        try:
            done = subprocess.run(
                command, cwd=folder, capture_output=True, text=True, timeout=SECONDS,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
        except subprocess.TimeoutExpired:
            return f"{key} = {value}: no end in {SECONDS} s"
        lines = done.stderr.splitlines()
        if done.returncode in (0, 1, 2) and len(lines) == (done.returncode != 0):
            if done.returncode == 0 or "memory" not in done.stderr:
                return None
        return f"{key} = {value}: status {done.returncode}, {' | '.join(lines)[:300]}"

    def test_every_option_at_its_extremes(self):
        self.write("small.toml", SMALL)
        options = Describe(self.say).options
        self.assertGreater(len(options), 200)
        trials = [(key, value, choices) for key, (takes, choices) in options.items()
                  for value in extremes(takes)]
        if not ALL:  # each option at some of them, other ones for other options
            trials = trials[::23]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            ends = pool.map(lambda each: self.outcome(*each[1], each[0]), enumerate(trials))
            wrong = [end for end in ends if end]
        self.assertEqual(wrong, [], f"{len(wrong)} of {len(trials)}")


if __name__ == "__main__":
    desk.main()
