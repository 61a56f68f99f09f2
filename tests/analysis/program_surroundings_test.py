"""What the `shoal` program does where its surroundings fail it: folders, files, pipes, memory.

    python3 program_surroundings_test.py SHOAL
"""

import json
import os
import resource
import subprocess

import desk
from desk import Desk


class Surroundings(Desk):
    def test_a_file_where_the_folder_should_be(self):
        self.write("taken", "mine")
        for out in ["taken", "taken/below"]:
            self.assert_complains(self.shoal("run", "ok.toml", "--out", out), 1, [out, "--out"])
        self.assertEqual((self.desk / "taken").read_text(), "mine")

    def test_a_folder_that_cannot_be_written(self):
        if os.geteuid() == 0:
            self.skipTest("root may write anywhere")
        (self.desk / "locked").mkdir(mode=0o555)
        self.assert_complains(self.shoal("run", "ok.toml", "--out", "locked"), 1, ["locked"])

    def test_a_full_disk_leaves_nothing_half_written(self):
        for limit in [0, 1024, 4096, 16384]:
            with self.subTest(f"{limit} bytes"):
                self.setUp()
                done = self.shoal(
                    "run", "ok.toml", "--out", "out",
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                self.assert_complains(done, 1, ["cannot write out/", "free space"])
                self.assertLessEqual(self.files(), {"ok.toml", "out/scenario.toml"})

    def test_results_that_are_cut_short_do_not_stand_beside_old_ones(self):
        self.run_trial("ok.toml")
        done = self.shoal(
            "run", "ok.toml", "--out", "out",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.files(), {"ok.toml", "out/scenario.toml"})

    def test_a_folder_where_a_result_should_be(self):
        self.write("out/summary.json/mine", "")
        self.assert_complains(self.shoal("run", "ok.toml", "--out", "out"), 1, ["summary.json"])

    def test_messages_that_cannot_be_written_end_no_work(self):
        for target in ["2>/dev/full", "2>&-"]:
            done = self.sh(f'"$SHOAL" run missing.toml {target}')
            self.assertEqual(done.returncode, 2, target)
            done = self.sh(f'"$SHOAL" run ok.toml --out out {target}')
            self.assertEqual(done.returncode, 0, target)

    def test_a_reader_that_has_read_enough_is_no_error(self):
        done = self.sh('"$SHOAL" list | true')
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_little_memory_is_no_reason_to_hang(self):
        done = self.sh('ulimit -v 1000000; "$SHOAL" --version')
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_file_without_an_end_is_refused(self):
        os.symlink("/dev/zero", self.desk / "zero")
        os.symlink("/dev/zero", self.desk / "zero.toml")
        for command in [["run", "zero.toml"], ["sweep", "zero.toml"], ["eval", "clamp", "zero"],
                        ["solve", "zero", "--solvers", "newton"]]:
            with self.subTest(command):
                self.assert_complains(self.shoal(*command), 2, ["zero", "64 MB", "most that is read"])
        self.write("plan.toml", desk.FILE_PLAN.replace("plan.csv", "zero"))
        self.assert_complains(self.shoal("run", "plan.toml"), 2, ["zero", "64 MB"])

    def test_names_that_no_folder_can_have(self):
        for out in ["x" * 300, "loop/out"]:
            if out.startswith("loop"):
                os.symlink("loop", self.desk / "loop")
            done = self.shoal("run", "ok.toml", "--out", out)
            self.assertIn(done.returncode, (1, 2))
            self.assert_complains(done, done.returncode, [out])
            self.assertNotIn("filesystem error", done.stderr)
            self.assertNotIn("what()", done.stderr)

    def test_pipes_are_written_to_and_links_stay(self):
        os.mkfifo(self.desk / "pipe")
        done = self.sh('cat pipe >got & "$SHOAL" corpus --duration 60 --keep 1 pipe; wait')
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.desk / "pipe").is_fifo())
        self.write("target.jsonl", "old")
        os.symlink("target.jsonl", self.desk / "link.jsonl")
        self.shoal("corpus", "--duration", "60", "--keep", "1", "link.jsonl")
        self.assertTrue((self.desk / "link.jsonl").is_symlink())
        self.assertEqual((self.desk / "target.jsonl").read_text(), (self.desk / "got").read_text())

    def test_a_run_writes_to_the_pipes_and_devices_in_its_folder(self):
        (self.desk / "out").mkdir()
        os.mkfifo(self.desk / "out/summary.json")
        os.symlink("/dev/null", self.desk / "out/run.nc")
        done = self.sh('cat out/summary.json >got & "$SHOAL" run ok.toml --out out >said; wait')
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.desk / "out/summary.json").is_fifo())
        self.assertTrue((self.desk / "out/run.nc").is_char_device())
        self.assertEqual(json.loads((self.desk / "got").read_text())["vehicles"], 4)

    def test_a_terminal_that_takes_nothing(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([desk.SHOAL, "list", "behaviour"], stdout=full, check=False,
                                  stderr=subprocess.PIPE, text=True)
        self.assert_complains(done, 1, ["cannot write"])


    def test_files_that_cannot_be_written_are_refused_before_the_work(self):
        for arguments in (["corpus", "ok.toml/c.jsonl"],
                          ["run", "ok.toml", "--record-problems", "ok.toml/c.jsonl"]):
            self.assert_complains(self.shoal(*arguments), 1,
                                  ["cannot write into ", "choose another place for ok.toml/c.jsonl"])
        self.assert_complains(self.shoal("corpus", "."), 1, ["cannot write .: it is a folder"])
        self.assert_complains(self.shoal("run", "ok.toml", "--keep", "9"), 2,
                              ["--keep requires --record-problems"])
        for name in ("summary.json", "../o/run.nc", "report.html"):
            self.assert_complains(
                self.shoal("run", "ok.toml", "--out", "o", "--record-problems", f"o/{name}"), 2,
                [f"--record-problems: o/{name} is a file of the run itself; give the problems another name"])
        self.assertFalse((self.desk / "o").exists())

    def test_more_numbers_than_fit_are_refused_by_check_too_and_no_folder_stays(self):
        much = ["trial.duration_s 1e+09 s: that is ", " numbers to keep, and at most 1e+09 are"]
        (self.desk / "much.toml").write_text("[trial]\nduration_s = 1e9\n[quality]\nevery_s = 0.25\n")
        self.assert_complains(self.shoal("check", "much.toml"), 2, much)
        self.assert_complains(self.shoal("run", "much.toml", "--out", "deep/er"), 2, much)
        self.assertFalse((self.desk / "deep").exists())

    def test_no_folder_is_made_for_profiles_of_a_corpus_that_is_none(self):
        self.assert_complains(self.shoal("solve", "ok.toml", "--solvers", "newton", "--profiles",
                                         "new/p.csv"), 2, ["ok.toml:1: "])
        self.assertFalse((self.desk / "new").exists())


if __name__ == "__main__":
    desk.main()
