"""shoal merge as its user sees it: parts in any order, conflicts, kills, folders in use.

    python3 merge_test.py SHOAL
"""

import json
import shutil
import signal
import sqlite3
import subprocess
import time

import desk
from study_desk import DAMAGED_MANIFESTS, SHORT, STUDY, TRIALS, StudyDesk


class Merge(StudyDesk):
    def setUp(self):
        super().setUp()
        self.write("study.toml", SHORT)

    def merge(self, *folders):
        done = self.shoal("merge", *folders)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def assert_refused(self, folders, status, parts):
        self.assert_complains(self.shoal("merge", *folders), status, parts)

    def parts(self, n=3):
        names = [f"part{i}" for i in range(1, n + 1)]
        for i, name in enumerate(names, 1):
            self.sweep("--shard", f"{i}/{n}", out=name)
        return names

    def change(self, out, statement, *values):
        store = sqlite3.connect(self.desk / out / "trials.sqlite")
        with store:
            changed = store.execute(statement, values).rowcount
        store.close()
        self.assertGreater(changed, 0)

    def text(self, file):
        return (self.desk / file).read_text()

    def content(self, out):
        """What must not change: the trials, and what is said of them."""
        return (self.rows("*", out), self.text(f"{out}/study.toml"),
                self.text(f"{out}/manifest.json"))

    def test_parts_merged_in_any_order_give_the_tables_of_one_sweep(self):
        self.sweep(out="whole")
        one, two, three = self.parts()
        said = self.merge("new", one, two, three)
        self.assertIn(f"{TRIALS} of {TRIALS} trials are stored, 0 failed, 0 are missing", said)
        self.merge("other", three, one, two)
        said = self.merge(two, three)  # into one of the parts
        self.assertIn("6 of 9 trials are stored, 0 failed, 3 are missing", said)
        self.assertIn("shoal sweep part2/study.toml --out part2 runs them", said)
        self.assertFalse((self.desk / two / "tables").exists())
        said = self.merge(two, one, two)  # which may stand among them
        self.assertIn("part2: 6 trials\npart1: 3 trials\n", said)
        for out in ["new", "other", two]:
            self.assertEqual(self.tables(out), self.tables("whole"))
            columns = "trial_key, trial_id, scenario_id, energy_mean_wh"
            self.assertEqual(self.rows(columns, out), self.rows(columns, "whole"))

    def test_what_is_missing_runs_in_the_merged_folder(self):
        self.sweep(out="whole")
        one, two, _ = self.parts()
        self.merge("new", one, two)
        self.assertIn("9 of 9 trials are stored, 3 of them run now",
                      self.sweep(study="new/study.toml", out="new"))
        self.assertEqual(self.tables("new"), self.tables("whole"))

    def test_the_manifest_keeps_every_sweep_and_tells_of_the_merge(self):
        one, two, three = self.parts()
        for name in [one, two]:
            manifest = json.loads(self.text(f"{name}/manifest.json"))
            manifest["sweeps"][0]["host"]["name"] = "host of " + name
            self.write(f"{name}/manifest.json", json.dumps(manifest))
        self.merge("new", one, two)
        self.merge("new", two, three)
        manifest = json.loads(self.text("new/manifest.json"))
        self.assertEqual([sweep["shard"] for sweep in manifest["sweeps"]], ["1/3", "2/3", "3/3"])
        self.assertEqual({s["host"]["name"] for s in manifest["sweeps"][:2]},
                         {"host of part1", "host of part2"})
        for sweep in manifest["sweeps"]:
            self.assertIn("Eigen", sweep["program"]["libraries"])
            self.assertLessEqual(sweep["began"], sweep["ended"])
        taken = [[(f["folder"].rsplit("/", 1)[-1], f["taken"]) for f in merge["folders"]]
                 for merge in manifest["merges"]]
        self.assertEqual(taken, [[("new", 0), ("part1", 3), ("part2", 3)],
                                 [("new", 6), ("part2", 0), ("part3", 3)]])
        self.sweep(study="new/study.toml", out="new")
        self.assertEqual(len(json.loads(self.text("new/manifest.json"))["merges"]), 2)

    def test_the_same_trial_in_two_folders_is_taken_once(self):
        self.sweep(out="whole")
        one, *_ = self.parts()
        self.assertIn("part1: 3 trials, 3 of them in a folder before it, too",
                      self.merge("whole", one))
        # A trial may take longer on another host.
        self.change(one, "UPDATE trial SET wall_s = wall_s + 1")
        self.merge("whole", one)
        self.assertEqual(len(self.rows("*", "whole")), TRIALS)

    def test_a_trial_that_came_out_differently_is_refused(self):
        self.sweep(out="whole")
        one, two, three = self.parts()
        shutil.copytree(self.desk / two, self.desk / "good")
        before = self.content("whole")
        which = "WHERE trial_key = '|behaviour=rigid_registration|delta_theta_deg=-|1'"
        for what, changed, said in [
                ("a measure", "energy_mean_wh = energy_mean_wh + 1e-9", "energy_mean_wh is 1.80"),
                ("null", "energy_mean_wh = NULL", "and null in the second"),
                ("status", "status = 'failed', reason = 'it sank'", "it is done in the first, and "
                 "failed (it sank) in the second")]:
            with self.subTest(what):
                self.change(two, f"UPDATE trial SET {changed} {which}")
                self.assert_refused(["whole", two, three], 2, [
                    "behaviour = rigid_registration, replication 2 differs between whole and part2",
                    said])
                self.assertEqual(self.content("whole"), before)
                self.assert_refused(["new", one, "whole", two], 2, ["whole and part2"])
                self.assertFalse((self.desk / "new").exists())
                shutil.rmtree(self.desk / two)
                shutil.copytree(self.desk / "good", self.desk / two)
        self.change(two, "UPDATE series SET numbers = zeroblob(length(numbers))")
        self.assert_refused(["whole", two], 2, ["the series quality"])

    def test_trials_of_another_program_or_scenario_are_refused(self):
        one, two, three = self.parts()
        self.change(two, "UPDATE trial SET program = '0.0.9-beef' WHERE replication = 1 AND "
                    "\"f:delta_theta_deg\" = '-'")
        self.assert_refused(["new", one, two], 2, [
            "behaviour = rigid_registration, replication 2 was run by shoal 0.0.9-beef in part2",
            "behaviour = ", "in part1", "--rerun-changed"])
        self.change(three, "UPDATE trial SET scenario_id = 'other' WHERE replication = 2 AND "
                    "\"f:delta_theta_deg\" = '45'")
        self.assert_refused(["new", one, three], 2, [
            "delta_theta_deg = 45, replication 3 was run in another scenario in part3",
            "delta_theta_deg = 45, replication 1 in part1"])
        self.assertFalse((self.desk / "new").exists())

    def test_a_seed_that_is_not_the_studys_is_refused(self):
        one, two, _ = self.parts()
        self.change(two, "UPDATE trial SET seed = 7 WHERE replication = 1 AND "
                    "\"f:delta_theta_deg\" = '-'")
        self.assert_refused(["new", one, two], 2, [
            "part2/trials.sqlite: the trial |behaviour=rigid_registration|delta_theta_deg=-|1: ",
            "seed is 7, and 2 in the study", "--rerun-changed"])
        self.assertFalse((self.desk / "new").exists())

    def test_a_scenario_that_changed_between_two_parts_is_refused(self):
        self.write("sea.toml", "[trial]\nduration_s = 90\n")
        self.write("study.toml", SHORT.replace('"construction_square"', '"sea.toml"')
                   .replace("= 90", "= 30").replace("trial.duration_s", "ping.period_s"))
        self.sweep("--shard", "1/2", out="one")
        self.write("sea.toml", "[trial]\nduration_s = 120\n")
        self.sweep("--shard", "2/2", out="two")
        self.assert_refused(["new", "one", "two"], 2, [
            "was run in another scenario in two", "in one", "the base scenario had changed"])

    def test_different_studies_are_refused_and_the_difference_named(self):
        self.sweep(out="one")
        self.sweep("--replications", 4, out="two")
        self.assert_refused(["new", "one", "two"], 2, [
            "one and two hold different studies", "study.toml", '"replications = 3"',
            '"replications = 4"'])
        claim = '[[claim]]\nsays = "so"\nmeasure = "fragments"\ntest.kind = "between"\n' \
                'test.between = { at_most = 1 }\n'
        self.write("claims.toml", claim)
        self.write("study.toml", 'claims = "claims.toml"\n' + SHORT)
        self.sweep("--shard", "1/2", out="three")
        self.write("claims.toml", "# more is said\n" + claim)
        self.sweep("--shard", "2/2", out="four")
        self.merge("new", "three", "four")
        self.assertIn("claims.md", self.tables("new"))
        self.write("claims.toml", claim.replace("= 1 }", "= 2 }"))
        self.sweep("--shard", "2/2", out="five")
        self.assert_refused(["newer", "three", "five"], 2, ["claims.toml", "at_most = 1",
                                                            "at_most = 2"])

    def test_what_is_no_folder_of_trials_is_refused(self):
        one, *_ = self.parts()
        self.write("empty/readme", "")
        for other in ["empty", "nowhere", "ok.toml"]:
            self.assert_refused(["new", one, other], 2, [f"{other} holds no trials of a study"])
        self.assertFalse((self.desk / "new").exists())
        self.write("mine/trials.sqlite", b"my own")
        self.assert_refused(["mine", one], 2, ["is no store of trials"])
        self.assertEqual({f for f in self.files() if f.startswith("mine")},
                         {"mine/trials.sqlite"})

    def test_a_damaged_manifest_is_refused_on_either_side(self):
        one, two, _ = self.parts()
        whole = (self.desk / two / "manifest.json").read_bytes()
        for content, wrong in DAMAGED_MANIFESTS:
            self.write(f"{two}/manifest.json", content)
            said = [f"{two}/manifest.json: ", wrong, "; move it away"]
            self.assert_refused([one, two], 2, said)
            self.assert_refused([two, one], 2, said)
            self.assertEqual((self.desk / two / "manifest.json").read_bytes(), content)
        self.write(f"{two}/manifest.json", whole)
        self.assertIn("6 of 9 trials are stored", self.merge(one, two))

    def test_a_folder_in_use_is_refused(self):
        one, two, _ = self.parts()
        self.write("long.toml", STUDY.replace("= 300", "= 18000"))
        with subprocess.Popen([desk.SHOAL, "sweep", "long.toml", "--out", "busy"], cwd=self.desk,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            while not (self.desk / "busy/manifest.json").exists():
                time.sleep(0.01)
            self.assert_refused(["busy", one], 2, ["hold different studies"])
            shutil.copy(self.desk / one / "study.toml", self.desk / "busy/study.toml")
            self.assert_refused(["busy", one], 1, ["busy is in use by another shoal"])
            self.assert_refused([one, two, "busy"], 1, ["busy is in use by another shoal"])
            running.kill()

    def big_part(self, replications):
        """A part of a study of many replications that would take too long to run."""
        self.write("study.toml", SHORT.replace("replications = 3", f"replications = {replications}")
                   .split("[[table]]")[0])
        self.sweep("--shard", f"1/{replications}", out="big")
        self.sweep("--shard", f"2/{replications}", out="small")
        store = sqlite3.connect(self.desk / "big/trials.sqlite")
        names = [row[1] for row in store.execute("PRAGMA table_info(trial)")]
        rows = [list(row) for row in store.execute("SELECT * FROM trial")]
        with store:
            for row in rows:
                copies = []
                for k in range(10, replications):
                    row[names.index("trial_key")] = row[names.index("trial_key")] \
                        .rsplit("|", 1)[0] + f"|{k}"
                    row[names.index("replication")], row[names.index("seed")] = k, k + 1
                    copies.append(tuple(row))
                store.executemany(f"INSERT OR REPLACE INTO trial VALUES ({','.join('?' * len(names))})",
                                  copies)
        store.close()

    def test_a_merge_that_is_killed_leaves_the_folder_as_it_was(self):
        self.big_part(4000)
        before = self.content("small")
        journal = self.desk / "small/trials.sqlite-wal"
        with subprocess.Popen([desk.SHOAL, "merge", "small", "big"], cwd=self.desk,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            while running.poll() is None and not (journal.exists() and
                                                  journal.stat().st_size > 500_000):
                time.sleep(0.001)
            running.kill()
        self.assertEqual(running.returncode, -signal.SIGKILL)  # and not done before
        self.assertEqual(self.content("small"), before)
        self.merge("small", "big")
        self.assertEqual(len(self.rows("trial_key", "small")),
                         len(self.rows("trial_key", "big")) + len(before[0]))


if __name__ == "__main__":
    desk.main()
