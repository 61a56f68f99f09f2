"""Sweeps as their user sees them: killed, continued, parted, changed, failing.

    python3 sweep_test.py SHOAL [--kills N]     (the program; N: default 4)
"""

import csv
import os
import pathlib
import random
import signal
import sqlite3
import subprocess
import sys
import time

import desk
from study_desk import DAMAGED_MANIFESTS, SHORT, STUDY, TRIALS, StudyDesk

KILLS = 4


SENSITIVITY = """scenario = "construction_square"
replications = 1
set = { trial.duration_s = 90 }

[design]
kind = "saltelli"
saltelli.base_samples = 4

[[factor]]
name = "radius"
key = "guidance.drift.drifting_radius_m"
range = [15, 75]

[[factor]]
name = "noise"
key = "ping.bearing_sd_deg"
range = [0, 15]

[[sensitivity]]
name = "indices"
measures = ["energy_mean_wh", "quality_final_m"]
"""


def children_of(pid):
    return [int(child) for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children")
            for child in task.read_text().split()]


def computes(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Sweep(StudyDesk):
    def test_the_tables_do_not_depend_on_the_number_of_jobs(self):
        self.assertIn(f"{TRIALS} of {TRIALS} trials are stored", self.sweep("--jobs", 1, out="one"))
        self.sweep("--jobs", 3, out="three")
        self.assertEqual(len(self.tables("one")), 6)
        self.assertEqual(self.tables("one"), self.tables("three"))
        self.assertIn(f"{TRIALS} of them run now", self.sweep(out="again"))
        self.assertIn(" 0 of them run now", self.sweep(out="again"))

    def test_a_sweep_that_is_killed_goes_on_where_it_was(self):
        self.write("long.toml", STUDY.replace("= 300", "= 1200"))
        self.sweep(study="long.toml", out="whole")
        moments = random.Random(1)
        stored = 0
        for _ in range(KILLS):
            with subprocess.Popen([desk.SHOAL, "sweep", "long.toml", "--out", "out", "--jobs", "2"],
                                  cwd=self.desk, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL) as running:
                time.sleep(moments.uniform(0.05, 0.4))
                os.kill(running.pid, signal.SIGKILL)
            if (self.desk / "out/trials.sqlite").exists():
                try:
                    now = len(self.rows("trial_key"))
                except sqlite3.OperationalError:  # killed before it made its tables
                    now = 0
                self.assertGreaterEqual(now, stored)
                stored = now
        self.sweep(study="long.toml")
        self.assertEqual(self.tables(), self.tables("whole"))
        self.assertEqual(self.rows("trial_id, energy_mean_wh"),
                         self.rows("trial_id, energy_mean_wh", "whole"))

    def test_trials_end_with_the_sweep_that_began_them(self):
        # Ipopt solves one problem at a time in a process, so that each trial gets its own.
        ipopt = ('behaviour = { kind = "attraction_repulsion", attraction_repulsion.solver.kind = "ipopt" }\n'
                 "trial.duration_s = 2000000")
        self.write("long.toml", 'scenario = "construction_square"\n[set]\n' + ipopt)
        with subprocess.Popen([desk.SHOAL, "sweep", "long.toml", "--jobs", "2"], cwd=self.desk,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            try:
                workers = self.until(lambda: len(children := children_of(running.pid)) == 2 and children)
            finally:
                os.kill(running.pid, signal.SIGKILL)
        self.until(lambda: not any(computes(worker) for worker in workers))

    def until(self, true, seconds=20.0):
        end = time.monotonic() + seconds
        while not (found := true()):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)
        return found

    def test_sensitivities_are_tables_like_others(self):
        self.write("indices.toml", SENSITIVITY)
        self.sweep(study="indices.toml")
        tables = self.tables()
        self.assertEqual(set(tables), {f"indices{part}.{kind}" for part in ("", "_convergence")
                                       for kind in ("csv", "md", "tex")})
        rows = list(csv.reader(tables["indices.csv"].decode().splitlines()))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        said = [(row[0], row[1]) for row in rows[1:]]
        self.assertEqual(said, [(measure, factor) for measure in
                                ("energy mean", "quality final")
                                for factor in ("radius", "noise")])
        total = rows[0].index("total")
        self.assertTrue(all(row[total] for row in rows[1:]), rows)
        self.assertEqual(self.shoal("tables", "out").returncode, 0)
        self.assertEqual(self.tables(), tables)

        wrong = {'"quality_final_m"': ('"qualty_final_m"', ["did you mean"]),
                 '"saltelli"\nsaltelli.base_samples = 4': ('"sobol"\nsobol.samples = 8',
                                                          ["needs design.kind"])}
        for right, (mistake, parts) in wrong.items():
            self.write("wrong.toml", SENSITIVITY.replace(right, mistake))
            done = self.shoal("sweep", "wrong.toml", "--out", "wrong")
            self.assert_complains(done, 2, ["wrong.toml:", *parts])

    def test_shards_part_the_trials(self):
        self.sweep("--shard", "1/2", out="first")
        self.sweep("--shard", "2/2", out="second")
        first, second = self.rows("trial_key", "first"), self.rows("trial_key", "second")
        self.assertEqual(len(first) + len(second), TRIALS)
        self.assertEqual(len(set(first + second)), TRIALS)

    def test_the_same_seeds_stand_in_every_cell(self):
        self.sweep()
        seeds = {}
        for behaviour, delta, seed in self.rows('"f:behaviour", "f:delta_theta_deg", seed'):
            seeds.setdefault((behaviour, delta), set()).add(seed)
        self.assertEqual(seeds, {("rigid_registration", "-"): {1, 2, 3},
                                 ("assignment_registration", "10"): {1, 2, 3},
                                 ("assignment_registration", "45"): {1, 2, 3}})

    def test_what_has_changed_is_not_mixed_in(self):
        self.sweep()
        before = self.rows("energy_mean_wh")
        self.write("study.toml", STUDY.replace("= 300", "= 310"))
        refused = self.shoal("sweep", "study.toml", "--out", "out")
        self.assert_complains(refused, 2, ["9 of the trials stored in out", "has changed",
                                           "--rerun-changed"])
        self.assertEqual(self.rows("energy_mean_wh"), before)
        self.assertIn("9 of them run now", self.sweep("--rerun-changed"))
        self.assertNotEqual(self.rows("energy_mean_wh"), before)

    def test_more_replications_run_only_what_is_missing(self):
        self.sweep()
        self.assertIn("12 of 12 trials are stored, 3 of them run now",
                      self.sweep("--replications", 4))

    def test_a_failed_trial_stays_with_its_reason_and_shows_in_the_tables(self):
        self.write("sea.toml", STUDY.replace("construction_square", "redsea_square") + """
[[factor]]
name = "late"
key = "current.netcdf.time_offset_s"
values = [0, 1000000]
""")
        text = (self.desk / "sea.toml").read_text()
        self.write("sea.toml", text.replace('pool = ["delta', 'pool = ["late", "delta')
                   .replace('"delta_theta_deg"]\nmeasures', '"delta_theta_deg", "late"]\nmeasures'))
        said = self.sweep(study="sea.toml")
        self.assertIn("9 failed; the first: ", said)
        reasons = {reason for status, reason in self.rows("status, reason") if status == "failed"}
        self.assertEqual(len(reasons), 1)
        self.assertIn("no current at", reasons.pop())
        self.assertIn("all 3 failed", self.tables()["energy.md"].decode())
        self.assertIn(" 0 of them run now", self.sweep(study="sea.toml"))
        self.assertIn(" 9 of them run now", self.sweep("--retry-failed", study="sea.toml"))
        self.sweep("--fail-fast", "--jobs", 1, study="sea.toml", out="fast")
        self.assertLess(len(self.rows("status", "fast")), 18)

    def test_a_second_sweep_of_the_same_folder_is_refused(self):
        self.write("long.toml", STUDY.replace("= 300", "= 18000"))
        with subprocess.Popen([desk.SHOAL, "sweep", "long.toml", "--out", "out"], cwd=self.desk,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            while not (self.desk / "out/manifest.json").exists():
                time.sleep(0.01)
            refused = self.shoal("sweep", "long.toml", "--out", "out")
            running.kill()
        self.assert_complains(refused, 1, ["out is in use by another shoal"])

    def test_a_store_that_another_program_holds_is_refused(self):
        self.write("short.toml", SHORT)
        self.sweep("--replications", 1, study="short.toml")
        store = sqlite3.connect(self.desk / "out/trials.sqlite")
        store.execute("BEGIN EXCLUSIVE")
        refused = [self.shoal("tables", "out"),
                   self.shoal("sweep", "short.toml", "--out", "out", "--replications", 1,
                              "--retry-failed")]
        store.close()
        for done in refused:
            self.assert_complains(done, 1, ["trials.sqlite: ", "is locked; another program holds it"])

    def test_a_damaged_manifest_is_refused_and_stays(self):
        self.write("short.toml", SHORT)
        few = ("--replications", 1)
        self.sweep(*few, study="short.toml")
        whole = (self.desk / "out/manifest.json").read_bytes()
        for content, wrong in DAMAGED_MANIFESTS + [(whole[:len(whole) // 2], "no valid JSON")]:
            with self.subTest(content[:20]):
                self.write("out/manifest.json", content)
                stored = self.rows("*")
                refused = self.shoal("sweep", "short.toml", "--out", "out", "--replications", 2)
                self.assert_complains(refused, 2, ["out/manifest.json: ", wrong, "; move it away"])
                self.assertEqual((self.desk / "out/manifest.json").read_bytes(), content)
                self.assertEqual(self.rows("*"), stored)
        (self.desk / "out/manifest.json").unlink()
        (self.desk / "out/manifest.json").mkdir()
        self.assert_complains(self.shoal("sweep", "short.toml", "--out", "out", *few), 2,
                              ["out/manifest.json: ", "cannot be read", "; move it away"])
        (self.desk / "out/manifest.json").rmdir()
        self.assertIn(" 0 of them run now", self.sweep(*few, study="short.toml"))

    def test_a_scenario_beside_the_study_is_found_from_everywhere(self):
        for text in [STUDY.replace('"construction_square"', '"sea.toml"').replace("300", "60"),
                     'replications = 2\n[[group]]\nname = "g"\nscenario = "sea.toml"\n']:
            self.write("below/study.toml", text)
            self.write("below/sea.toml", "[trial]\nduration_s = 60\n")
            self.sweep("--rerun-changed", study="below/study.toml")
            self.assertIn(" 0 of them run now", self.sweep(study="out/study.toml"))

    def test_bad_studies_are_refused_before_anything_runs(self):
        for what, wrong, right, parts in [
                ("a key", "delta_thta", "delta_theta", ['no option "delta_thta_deg"', "did you mean"]),
                ("a value", "[10, 450]", "[10, 45]", ["delta_theta_deg is 450", "in the cell"]),
                ("a measure", "energy_mean\"", "energy_mean_wh\"", ['"energy_mean"', "did you mean"]),
                ("a row", 'rows = ["behavior"', 'rows = ["behaviour"', ['"behavior"', "did you mean"]),
                ("a factor left out", 'rows = ["behaviour"]', 'rows = ["behaviour", "delta_theta_deg"]',
                 ["delta_theta_deg has several levels", "pool"]),
                ("the name of a group", '[[group]]\nname = "a/b"\nscenario = "x"\n',
                 STUDY, ['the name "a/b" becomes that of a file']),
                ("a base", "construction_squre", "construction_square", ["did you mean"])]:
            with self.subTest(what):
                self.write("bad.toml", STUDY.replace(right, wrong))
                done = self.shoal("sweep", "bad.toml", "--out", "bad")
                self.assert_complains(done, 2, ["bad.toml", *parts])
                self.assertFalse((self.desk / "bad/manifest.json").exists())


if __name__ == "__main__":
    if "--kills" in sys.argv:
        place = sys.argv.index("--kills")
        KILLS = int(sys.argv.pop(place + 1))
        sys.argv.pop(place)
    desk.main()
