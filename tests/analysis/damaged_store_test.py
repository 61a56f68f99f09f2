"""A store of trials that was damaged: refused with its name, the trial and the column.

    python3 damaged_store_test.py SHOAL
"""

import shutil
import sqlite3

import desk
from study_desk import SHORT, StudyDesk

KEY = "|behaviour=rigid_registration|delta_theta_deg=-|0"
DAMAGED = "the file is damaged, move it away and run the study again"

# What is set, and what is said of it.
VALUES = [
    ("energy_mean_wh = 'abc'", "energy_mean_wh holds no number"),
    ("energy_mean_wh = '3abc'", "energy_mean_wh holds no number"),
    ("energy_mean_wh = x'00'", "energy_mean_wh holds no number"),
    ("wall_s = 'long'", "wall_s holds no number"),
    ("seed = 'one'", "seed holds no integer"),
    ("seed = 1.5", "seed holds no integer"),
    ("replication = -1", "replication holds no integer of 0 or more"),
    ("replication = 4294967296", "replication holds no integer of 0 or more"),
    ("program = x'00'", "program holds no text"),
    ("status = 'lost'", 'status holds no "done" and no "failed"'),
    ("status = 'failed'", "reason holds no text"),
    ("\"f:behaviour\" = x'00'", "f:behaviour holds no text"),
]
OTHERS = [
    ("seed = -1", "seed is -1, and 1 in the study"),
    ("seed = 2", "seed is 2, and 1 in the study"),
    ("replication = 1", "replication is 1, and 0 in the study"),
    ("study_group = 'other'", 'study_group is "other", and "" in the study'),
    ('"f:behaviour" = \'rigid\'', 'f:behaviour is "rigid", and "rigid_registration" in the study'),
    ('"f:delta_theta_deg" = NULL', 'f:delta_theta_deg is null, and "-" in the study'),
]


class DamagedStore(StudyDesk):
    def setUp(self):
        super().setUp()
        self.write("study.toml", SHORT)
        self.sweep("--replications", 1)
        shutil.copytree(self.desk / "out", self.desk / "whole")

    def change(self, statement):
        shutil.copy(self.desk / "whole/trials.sqlite", self.desk / "out/trials.sqlite")
        store = sqlite3.connect(self.desk / "out/trials.sqlite")
        with store:
            store.execute(statement)
        store.close()

    def resume(self, *arguments):
        return self.shoal("sweep", "study.toml", "--out", "out", "--replications", 1, *arguments)

    def test_a_value_that_no_store_writes_is_refused(self):
        for what, said in VALUES:
            with self.subTest(what):
                self.change(f"UPDATE trial SET {what} WHERE trial_key = '{KEY}'")
                for command in ["tables", "export"]:
                    self.assert_complains(self.shoal(command, "out"), 2,
                                          ["out/trials.sqlite: ", f"the trial {KEY}: ", said, DAMAGED])

    def test_a_seed_or_a_label_that_is_not_the_studys_is_refused_and_run_again(self):
        for what, said in OTHERS:
            with self.subTest(what):
                self.change(f"UPDATE trial SET {what} WHERE trial_key = '{KEY}'")
                self.assert_complains(self.shoal("tables", "out"), 2,
                                      ["out/trials.sqlite: ", f"the trial {KEY}: ", said,
                                       "--rerun-changed"])
                self.assert_complains(self.resume(), 2, ["--rerun-changed"])
        self.assertIn(" 1 of them run now", self.sweep("--replications", 1, "--rerun-changed"))
        self.assertEqual(self.tables(), self.tables("whole"))

    def test_a_damaged_series_is_refused(self):
        for what in ["numbers = 'abc'", "time_s = x'00'", "time_s = 7"]:
            with self.subTest(what):
                self.change(f"UPDATE series SET {what} WHERE trial_key = '{KEY}'")
                self.assert_complains(self.shoal("tables", "out"), 2,
                                      ["out/trials.sqlite: ", f"the trial {KEY}",
                                       "no numbers in " + what.split()[0], DAMAGED])

    def test_a_missing_table_is_a_damage(self):
        for table in ["trial", "series", "factor", "metric"]:
            with self.subTest(table):
                self.change(f"DROP TABLE {table}")
                for done in [self.shoal("tables", "out"), self.resume()]:
                    self.assert_complains(done, 2, ["out/trials.sqlite: ", f"no table {table}", DAMAGED])
        self.change("ALTER TABLE trial DROP COLUMN wall_s")
        self.assert_complains(self.shoal("tables", "out"), 1,
                              ["trials.sqlite: ", "no such column: wall_s", "the file is damaged"])

    def test_a_folder_may_have_a_name_like_an_address(self):
        self.sweep("--replications", 1, out="file:x")
        self.assertEqual(self.tables("file:x"), self.tables("whole"))


if __name__ == "__main__":
    desk.main()
