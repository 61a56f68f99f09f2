"""`inherits` in scenarios, on the command line and in studies; the sets that ship.

    python3 inherits_test.py SHOAL
"""

import csv
import pathlib

import desk
from study_desk import StudyDesk

OWN = 'inherits = "program"\n' + desk.SMALL
STUDY = """scenario = "own.toml"
replications = 2
set = { trial.duration_s = 60 }

[[factor]]
name = "settings"
key = "inherits"
values = ["text", "program"]

[[table]]
name = "energy"
rows = ["settings"]
measures = ["energy_mean_wh"]
"""


class Inherits(StudyDesk):
    def setUp(self):
        super().setUp()
        self.write("own.toml", OWN)

    def whole(self, out):
        return (self.desk / out / "scenario.toml").read_text()

    def cells(self, out="out"):
        """Label of the settings -> energies of its trials."""
        cells = {}
        done = self.shoal("export", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.desk / out / "trials.csv", newline="", encoding="utf-8") as file:
            for trial in csv.DictReader(file):
                cells.setdefault(trial["settings"], []).append(trial["energy_mean_wh"])
        return cells

    def test_the_resolved_scenario_inherits_nothing_and_gives_the_same_bits(self):
        first = self.run_trial("own.toml", out="first")
        self.assertNotIn("inherits", self.whole("first"))
        self.assertIn('update = "tick"', self.whole("first"))
        again = self.run_trial("first/scenario.toml", out="again")
        self.assertEqual(first["measures"], again["measures"])
        self.assertEqual(self.whole("first"), self.whole("again"))

    def test_set_replaces_what_the_file_inherits(self):
        self.run_trial("own.toml", "--set", "inherits=text", out="text")
        self.assertIn('update = "ping"', self.whole("text"))
        self.run_trial("own.toml", "--set", "inherits=text", "--set", "planner.update=tick",
                       out="tick")
        self.assertIn('update = "tick"', self.whole("tick"))

    def test_files_of_ones_own_are_inherited(self):
        self.write("lab/mine.toml", 'inherits = "text"\n[ping]\nperiod_s = 11\n')
        self.write("lab/run.toml", 'inherits = "mine.toml"\n' + desk.SMALL)
        self.run_trial("lab/run.toml", out="out")
        self.assertIn("period_s = 11.0", self.whole("out"))
        self.run_trial("own.toml", "--set", "inherits=lab/mine.toml", out="set")
        self.assertIn("period_s = 11.0", self.whole("set"))
        self.run_trial("own.toml", "--set", 'inherits=["program", "lab/mine.toml"]', out="list")
        self.assertIn("period_s = 11.0", self.whole("list"))
        self.assertIn("start_depth_m = 0.0", self.whole("list"))

    def test_check_says_what_is_inherited(self):
        done = self.shoal("check", "own.toml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        inherited = [pathlib.Path(line.split()[-1]).name for line in done.stdout.splitlines()[1:]]
        self.assertEqual(inherited, ["program.toml", "ours.toml"])

    def test_sets_are_listed_and_described(self):
        listed = self.shoal("list", "sets").stdout
        for name in ["text", "program", "ours"]:
            self.assertRegex(listed, rf"  {name} +\w")
            self.assertEqual(self.shoal("check", name).returncode, 0)
        text = self.shoal("describe", "text").stdout
        self.assertRegex(text, r"ownship_weight = 0.1 +# Table 3.7")
        self.assertRegex(self.shoal("describe", "program").stdout, r"turning_power_w = 96.0 +# ")
        self.assertIn("program", self.shoal("describe", "inherits").stdout)
        self.assert_complains(self.shoal("describe", "progam"), 2, ['did you mean "program"?'])
        self.assert_complains(self.shoal("run", "own.toml", "--set", "inherits=txt"), 2,
                              ["--set inherits=txt", 'no set or scenario "txt"', '"text"?'])

    def test_no_scenario_is_left_out_by_exchanging_a_set(self):
        self.write("mine.toml", 'inherits = ["redsea_square", "text"]\n' + desk.SMALL)
        run = ["run", "mine.toml", "--no-report"]
        self.assert_complains(self.shoal(*run, "--set", "inherits=program"), 2,
                              ["inherits would leave out redsea_square",
                               'inherits = ["redsea_square", "program"]'])
        both = 'inherits=["redsea_square", "program"]'
        self.assertEqual(self.shoal(*run, "--set", both).returncode, 0)
        self.write("lost.toml", 'scenario = "mine.toml"\nset = { inherits = "program" }\n')
        self.assert_complains(self.shoal("check", "lost.toml"), 2,
                              ["inherits would leave out redsea_square"])

    def test_a_wrong_key_is_named_in_the_file_that_has_it(self):
        self.write("lab/mine.toml", "[ping]\nperoid_s = 11\n")
        self.write("run.toml", 'inherits = "lab/mine.toml"\n')
        for command in [["run", "run.toml"], ["check", "run.toml"]]:
            self.assert_complains(self.shoal(*command), 2,
                                  ["lab/mine.toml:2: ", 'no option "peroid_s"', '"period_s"?'])

    def test_a_row_of_files_that_inherit_one_another_has_an_end(self):
        for k in range(40):
            self.write(f"{k}.toml", f'inherits = "./{k + 1}.toml"\n')
        self.write("40.toml", desk.SMALL)
        self.assertEqual(self.shoal("check", "9.toml").returncode, 0)
        refused = self.shoal("check", "0.toml")
        self.assert_complains(refused, 2, [".toml:1: ", "more than 32 files inherit one another"])

    def test_a_study_varies_what_is_inherited(self):
        self.write("study.toml", STUDY)
        self.sweep()
        swept = self.cells()
        self.assertEqual({name: len(set(cell)) for name, cell in swept.items()},
                         {"text": 2, "program": 2})
        for name, cell in swept.items():
            for seed, energy in zip([1, 2], cell):
                alone = self.run_trial("own.toml", "--set", f"inherits={name}", "--seed", seed)
                self.assertAlmostEqual(float(energy), alone["measures"]["energy_mean_wh"], 9)

    def test_a_stored_study_finds_the_files_it_inherits_from_anywhere(self):
        self.write("lab/mine.toml", 'inherits = "text"\n[ping]\nperiod_s = 11\n')
        self.write("lab/study.toml", STUDY.replace("own.toml", "../own.toml")
                   .replace('"program"]', '"mine.toml"]')
                   .replace("set = {", 'set = { inherits = "mine.toml",'))
        self.sweep(study="lab/study.toml")
        stored = (self.desk / "out" / "study.toml").read_text()
        self.assertEqual(stored.count(str(self.desk.resolve() / "lab/mine.toml")), 2)
        self.assertIn('"text"', stored)
        before = self.cells()
        self.assertEqual({name: len(cell) for name, cell in before.items()},
                         {"text": 2, "mine.toml": 2})
        self.assertEqual(self.shoal("tables", "out").returncode, 0)
        self.sweep(study="out/study.toml", out="again")
        self.assertEqual(before, self.cells("again"))

    def test_a_stored_study_keeps_the_labels_of_scenarios_that_are_files(self):
        self.write("lab/a.toml", OWN)
        self.write("lab/b.toml", OWN.replace("program", "text"))
        self.write("lab/study.toml", """replications = 1
[[factor]]
key = "scenario"
name = "settings"
values = ["a.toml", "b.toml"]
[[table]]
name = "energy"
rows = ["settings"]
measures = ["energy_mean_wh"]
""")
        self.assertIn("2 of 2 trials are stored", self.sweep(study="lab/study.toml"))
        self.assertEqual(set(self.cells()), {"a.toml", "b.toml"})

    def test_a_study_of_unknown_settings_is_refused(self):
        self.write("study.toml", STUDY.replace('"program"]', '"progam"]'))
        self.assert_complains(self.shoal("sweep", "study.toml", "--out", "out"), 2,
                              ["study.toml:", 'no set or scenario "progam"', '"program"?'])


if __name__ == "__main__":
    desk.main()
