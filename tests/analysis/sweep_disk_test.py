"""Sweeps, merges and exports where nothing more can be written.

    python3 sweep_disk_test.py SHOAL
"""

import os
import resource
import sqlite3
import subprocess

import desk
from study_desk import SHORT, TRIALS, StudyDesk

NOBODY = 65534


def at_most(size):
    """No file may be larger: what a full disk is like to a program, also for root."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class FullDisk(StudyDesk):
    def setUp(self):
        super().setUp()
        self.write("study.toml", SHORT)

    def stored(self, out):
        try:
            return len(self.rows("trial_key", out))
        except sqlite3.OperationalError:  # it did not come to make its tables
            return 0

    def test_a_full_disk_ends_a_sweep_that_goes_on_when_there_is_space(self):
        self.sweep(out="whole")
        counts = []
        for size in [8_000, 60_000, 100_000]:
            with self.subTest(f"files of {size} bytes"):
                out = f"out{size}"
                full = self.shoal("sweep", "study.toml", "--out", out, "--jobs", 2,
                                  preexec_fn=at_most(size))
                self.assert_complains(full, 1, ["cannot", "trials.sqlite", "check free space"])
                counts.append(self.stored(out))
                self.assertFalse((self.desk / out / "tables").exists())
                self.assertIn(f"{TRIALS} of {TRIALS} trials are stored, {TRIALS - counts[-1]} of "
                              "them run now", self.sweep(out=out))
                self.assertEqual(self.tables(out), self.tables("whole"))
        self.assertTrue(any(0 < count < TRIALS for count in counts), counts)

    def test_a_file_system_that_fills_up_ends_a_sweep_likewise(self):
        small = self.desk / "small"
        small.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=160k", "tmpfs", small],
                               capture_output=True, check=False)
        if mount.returncode != 0:
            self.skipTest("no file system can be mounted here")
        self.addCleanup(subprocess.run, ["umount", small], check=True)
        full = self.shoal("sweep", "study.toml", "--out", "small/out", "--jobs", 2)
        self.assert_complains(full, 1, ["cannot", "trials.sqlite", "full", "check free space"])
        stored = self.stored("small/out")
        self.assertLess(stored, TRIALS)
        subprocess.run(["mount", "-o", "remount,size=4m", small], check=True)
        self.assertIn(f"{TRIALS - stored} of them run now", self.sweep(out="small/out"))
        self.sweep(out="whole")
        self.assertEqual(self.tables("small/out"), self.tables("whole"))

    def test_a_full_disk_leaves_a_merge_undone(self):
        for i in [1, 2]:
            self.sweep("--shard", f"{i}/2", out=f"part{i}")
        rows, manifest = self.rows("*", "part1"), (self.desk / "part1/manifest.json").read_bytes()
        for size in [1_000, 20_000, 30_000]:
            for folders in [["part1", "part2"], ["new", "part1", "part2"]]:
                with self.subTest(f"{size} bytes, {folders}"):
                    full = self.shoal("merge", *folders, preexec_fn=at_most(size))
                    self.assert_complains(full, 1, ["cannot", "free space"])
                    self.assertEqual(self.rows("*", "part1"), rows)
                    self.assertEqual((self.desk / "part1/manifest.json").read_bytes(), manifest)
                    self.assertFalse((self.desk / "new").exists())
        self.assertEqual(self.shoal("merge", "part1", "part2").returncode, 0)
        self.assertEqual(len(self.rows("*", "part1")), TRIALS)

    def test_a_full_disk_leaves_no_half_of_an_export(self):
        self.sweep()
        before = self.files()
        for size in [0, 1_000]:
            full = self.shoal("export", "out", preexec_fn=at_most(size))
            self.assert_complains(full, 1, ["cannot write out/", "free space"])
        self.assertEqual(self.files(), before)
        full = self.shoal("export", "out", preexec_fn=at_most(20_000))
        self.assert_complains(full, 1, ["cannot write out/study.nc", "free space"])
        self.assertEqual(self.files(), before | {"out/trials.csv"})


class ReadOnly(StudyDesk):
    """Without the right to write anywhere: root takes the rights of another user."""

    def shoal(self, *arguments, **settings):
        if os.geteuid() == 0:
            settings["user"] = settings["group"] = NOBODY
            settings["extra_groups"] = []
        return super().shoal(*arguments, **settings)

    def setUp(self):
        super().setUp()
        self.sweep_out = self.desk / "out"
        done = super().shoal("sweep", "study.toml", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        for place, _, files in os.walk(self.desk):
            os.chmod(place, 0o555)
            for file in files:
                os.chmod(os.path.join(place, file), 0o444)
        self.addCleanup(self.unlock)
        try:
            self.shoal("--version")
        except PermissionError:
            self.skipTest("nobody may not run the program here")

    def unlock(self):
        for place, _, _ in os.walk(self.desk):
            os.chmod(place, 0o755)

    def test_a_folder_that_cannot_be_written_is_refused(self):
        for command in [["sweep", "study.toml", "--out", "out"], ["tables", "out"],
                        ["sweep", "study.toml", "--out", "new"], ["export", "out"],
                        ["merge", "new", "out"]]:
            with self.subTest(command):
                self.assert_complains(self.shoal(*command), 1, ["cannot write", "ermission"])

    def test_trials_can_be_read_where_nothing_can_be_written(self):
        self.assertEqual(self.shoal("claims", "out").returncode, 2)  # it has none
        os.chmod(self.desk, 0o777)
        for command in [["merge", "new", "out"], ["export", "out", "--out", "exported"]]:
            done = self.shoal(*command)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.tables("new"), self.tables("out"))


if __name__ == "__main__":
    desk.main()
