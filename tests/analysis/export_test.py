"""shoal export as its user reads it: trials.csv with csv, study.nc with netCDF4 and xarray.

    python3 export_test.py SHOAL
"""

import csv
import math

import desk
from study_desk import SHORT, STUDY, StudyDesk

try:
    import netCDF4
    import xarray
except ImportError as missing:
    xarray = None
    WHY = f"skipped: {missing}; apt-get install python3-xarray python3-netcdf4"

GROUPS = """title = "a grid with gaps, and drawn cells"
replications = 2
set = { trial.duration_s = 60 }
series = ["quality"]

[[group]]
name = "grid"
scenario = "construction_square"
[[group.factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "assignment_registration"]
[[group.factor]]
name = "period"
key = "ping.period_s"
values = [15, 30]
[[group.exclude]]
behaviour = "rigid_registration"
period = 30

[[group]]
name = "drawn"
scenario = "construction_square"
replications = 3
design.kind = "latin_hypercube"
design.latin_hypercube.samples = 4
set = { quality.every_s = 20 }
[[group.factor]]
key = "ping.period_s"
range = [5, 60]
[[group.factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing"]

[[group]]
name = "sea"
scenario = "redsea_square"
[[group.factor]]
name = "late"
key = "current.netcdf.time_offset_s"
values = [0, 1000000]
[[group.factor]]
name = "words / signs"
[[group.factor.level]]
label = 'one, "two"'
"""


class Export(StudyDesk):
    def setUp(self):
        super().setUp()
        self.write("study.toml", SHORT)
        self.write("groups.toml", GROUPS)

    def export(self, *arguments):
        done = self.shoal("export", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def trials(self, out="out"):
        with open(self.desk / out / "trials.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def stored(self, columns, out="out"):
        """Of each trial by group, labels and replication from 1."""
        return {(key.rsplit("|", 1)[0], replication + 1): values for key, replication, *values
                in self.rows("trial_key, replication, " + columns, out)}

    def test_the_trials_stand_in_the_order_of_the_plan_with_the_numbers_stored(self):
        self.sweep()
        self.assertIn("written: out/{trials.csv,study.nc}, 9 trials, 0 failed, 0 missing",
                      self.export("out"))
        trials = self.trials()
        order = [(t["behaviour"], t["delta_theta_deg"], t["replication"], t["seed"])
                 for t in trials]
        self.assertEqual(order, [(behaviour, delta, k, k) for behaviour, delta in [
            ("rigid_registration", ""), ("assignment_registration", "10"),
            ("assignment_registration", "45")] for k in "123"])
        stored = self.stored("energy_mean_wh, quality_final_m, time_to_quality_20m_s")
        for t in trials:
            key = (f"|behaviour={t['behaviour']}|delta_theta_deg={t['delta_theta_deg'] or '-'}",
                   int(t["replication"]))
            self.assertEqual([float(t[name]) if t[name] else None for name in [
                "energy_mean_wh", "quality_final_m", "time_to_quality_20m_s"]], stored[key])
            self.assertEqual((t["study_group"], t["status"], t["reason"]), ("", "done", ""))

    def test_every_measure_is_there_and_names_its_unit(self):
        self.sweep()
        self.export("out", "--out", "elsewhere")
        run = self.run_trial("construction_square", "--set", "trial.duration_s=60", out="one")
        header = list(self.trials("elsewhere")[0])
        self.assertEqual(header[:7], ["study_group", "behaviour", "delta_theta_deg", "replication",
                                      "seed", "status", "reason"])
        self.assertEqual(header[7:], list(run["measures"]))
        self.assertNotIn("out/trials.csv", self.files())

    def test_a_label_is_no_formula_of_a_spreadsheet(self):
        labels = ["=1+1", "-x", "@a", "-3.5"]
        levels = "".join(f'[[factor.level]]\nlabel = "{label}"\n' for label in labels)
        self.write("signs.toml", 'scenario = "construction_square"\nreplications = 1\n'
                   'set = { trial.duration_s = 30 }\n[[factor]]\nname = "words"\n' + levels)
        self.sweep(study="signs.toml")
        self.export("out")
        self.assertEqual([t["words"] for t in self.trials()], ["'=1+1", "'-x", "'@a", "-3.5"])

    def test_groups_missing_and_failed_trials_are_told_apart(self):
        self.sweep("--shard", "1/2", study="groups.toml")
        self.assertIn("22 trials, 1 failed, 11 missing", self.export("out"))
        trials = self.trials()
        self.assertEqual([t["status"] for t in trials].count("missing"), 11)
        self.assertEqual([t["study_group"] for t in trials],
                         ["grid"] * 6 + ["drawn"] * 12 + ["sea"] * 4)
        # The factor period is in seconds, and does not say so; period_s does.
        self.assertEqual({(t["study_group"], bool(t["period_s"])) for t in trials},
                         {("grid", True), ("drawn", True), ("sea", False)})
        failed = [t for t in trials if t["status"] == "failed"]
        self.assertEqual([t["late_s"] for t in failed], ["1000000"])
        self.assertIn("no current at", failed[0]["reason"])
        self.assertEqual({t["energy_mean_wh"] for t in trials if t["status"] != "done"}, {""})
        self.assertNotIn("", {t["energy_mean_wh"] for t in trials if t["status"] == "done"})

    def test_text_is_quoted_as_rfc_4180_asks(self):
        self.sweep("--shard", "1/2", study="groups.toml")
        self.export("out")
        self.assertIn('1000000,"one, ""two""",1,1,failed,"', (self.desk / "out/trials.csv").read_text())

    def test_merged_parts_export_the_same_bytes(self):
        self.sweep(out="whole")
        for i in [1, 2]:
            self.sweep("--shard", f"{i}/2", out=f"part{i}")
        self.assertEqual(self.shoal("merge", "new", "part2", "part1").returncode, 0)
        for out in ["whole", "new"]:
            self.export(out)
        for file in ["trials.csv", "study.nc"]:
            self.assertEqual((self.desk / "new" / file).read_bytes(),
                             (self.desk / "whole" / file).read_bytes(), file)

    def test_a_factor_that_hides_a_column_is_refused(self):
        for name in ["energy_mean_wh", "quality", "status", "time", "cell"]:
            with self.subTest(name):
                self.write("bad.toml", SHORT.split("[[table]]")[0]
                           .replace('name = "behaviour"', f'name = "{name}"')
                           .replace("only = { behaviour", f"only = {{ {name}"))
                self.assert_complains(self.shoal("sweep", "bad.toml", "--out", "bad"), 2,
                                      ["bad.toml:6: a factor cannot be called", name])

    def test_a_folder_without_trials_is_refused(self):
        self.assert_complains(self.shoal("export", "nowhere"), 2, ["nowhere holds no trials.sqlite"])

    def open(self, **options):
        if not xarray:
            self.skipTest(WHY)
        dataset = xarray.open_dataset(self.desk / "out/study.nc", **options)
        self.addCleanup(dataset.close)
        return dataset

    def test_factors_are_dimensions_that_xarray_selects_by(self):
        self.sweep()
        self.export("out")
        study = self.open()
        self.assertEqual(study.energy_mean_wh.dims, ("behaviour", "delta_theta_deg", "replication"))
        self.assertEqual(study.attrs["title"], "two behaviours")
        self.assertEqual(study.energy_mean_wh.attrs["units"], "W h")
        self.assertEqual(study.delta_theta_deg.attrs["units"], "degree")
        self.assertEqual(list(study.delta_theta_deg.values[:2]), [10.0, 45.0])
        self.assertTrue(math.isnan(study.delta_theta_deg.values[2]))  # where it does not apply
        self.assertEqual(list(study.seed.values), [1, 2, 3])
        self.assertIn("seed", study.energy_mean_wh.coords)
        for (cell, k), (energy,) in self.stored("energy_mean_wh").items():
            behaviour, delta = [part.split("=")[1] for part in cell.split("|")[1:]]
            at = study.sel(behaviour=behaviour, replication=k).isel(
                delta_theta_deg={"10": 0, "45": 1, "-": 2}[delta])
            self.assertEqual(float(at.energy_mean_wh), energy)
            self.assertEqual(int(at.status), 3)
        self.assertEqual(float(study.energy_mean_wh.sel(
            behaviour="assignment_registration", delta_theta_deg=45, replication=2)),
            self.stored("energy_mean_wh")[
                ("|behaviour=assignment_registration|delta_theta_deg=45", 2)][0])
        # What is no cell of the study has no values.
        nowhere = study.sel(behaviour="rigid_registration", delta_theta_deg=[10, 45])
        self.assertTrue(nowhere.energy_mean_wh.isnull().all())
        self.assertTrue((nowhere.status == 0).all())

    def test_every_measure_has_its_unit_and_says_what_it_is(self):
        self.sweep()
        self.export("out")
        study = self.open()
        names = set(self.trials()[0]) - {"study_group", "behaviour", "delta_theta_deg",
                                         "replication", "seed", "reason"}
        self.assertEqual(set(study.data_vars), names | {"quality_over_time"})
        said = self.shoal("describe", "energy_mean_wh").stdout
        self.assertIn(": " + study.energy_mean_wh.attrs["long_name"], said)
        for name in names - {"status"}:
            self.assertIn("units", study[name].attrs, name)
            self.assertTrue(study[name].attrs["long_name"], name)

    def test_series_run_along_time(self):
        self.sweep()
        self.export("out")
        study = self.open()
        self.assertEqual(study.quality_over_time.dims,
                         ("behaviour", "delta_theta_deg", "replication", "time"))
        self.assertEqual(list(study.time.values), [0, 30, 60, 90])
        self.assertEqual((study.time.attrs["units"], study.quality_over_time.attrs["units"]),
                         ("s", "m"))
        last = study.quality_over_time.sel(time=90).values
        self.assertEqual(str(last), str(study.quality_final_m.values))
        self.assertEqual(int(study.quality_over_time.notnull().sum()), 9 * 4)

    def test_groups_of_a_study_are_groups_of_the_file(self):
        self.sweep("--shard", "1/2", study="groups.toml")
        self.export("out")
        if not xarray:
            self.skipTest(WHY)
        with netCDF4.Dataset(self.desk / "out/study.nc") as file:
            self.assertEqual(set(file.groups), {"grid", "drawn", "sea"})
        grid = self.open(group="grid")
        self.assertEqual(dict(grid.sizes),
                         {"behaviour": 2, "period": 2, "replication": 2, "time": 3})
        self.assertEqual(grid.status.sel(behaviour="rigid_registration", period=30).values.tolist(),
                         [0, 0])
        self.assertEqual(grid.status.sel(behaviour="rigid_registration", period=15).values.tolist(),
                         [3, 1])
        self.assertEqual(self.open(group="sea").status.sel(late=1e6).values.tolist(),
                         [[2, 1]])

    def test_drawn_cells_run_along_one_dimension_with_their_factors(self):
        self.sweep(study="groups.toml")
        self.export("out")
        drawn = self.open(group="drawn")
        self.assertEqual(drawn.energy_mean_wh.dims, ("cell", "replication"))
        self.assertEqual(list(drawn.cell.values), [1, 2, 3, 4])
        self.assertEqual(set(drawn.energy_mean_wh.coords),
                         {"cell", "replication", "seed", "period_s", "behaviour"})
        self.assertEqual(drawn.period_s.dims, ("cell",))
        self.assertEqual(list(drawn.time.values), [0, 20, 40, 60])  # and not those of the others
        self.assertEqual(self.open(group="sea").sizes["words___signs"], 1)
        trials = [t for t in self.trials() if t["study_group"] == "drawn"]
        for t in trials:
            at = drawn.sel(cell=int(t["sample"]), replication=int(t["replication"]))
            self.assertEqual((float(at.period_s), str(at.behaviour.values), float(at.energy_mean_wh)),
                             (float(t["period_s"]), t["behaviour"], float(t["energy_mean_wh"])))
        pairwise = drawn.where(drawn.behaviour == "pairwise_referencing", drop=True)
        self.assertEqual(pairwise.sizes["cell"], 2)


class CheckAndList(StudyDesk):
    def say(self, *arguments):
        done = self.shoal(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_studies_that_ship_are_listed_with_their_titles(self):
        self.assertRegex(self.say("list", "studies"), r"\n  thesis_chapter5 +Rypkema 2015")
        self.assertEqual(self.say("list", "study"), self.say("list", "studies"))

    def test_check_says_what_a_study_would_run(self):
        self.write("groups.toml", GROUPS)
        said = self.say("check", "study.toml", "groups.toml", "thesis_chapter5", "ok.toml")
        self.assertIn("study.toml: a study of 9 trials in 3 cells; tables: 2, claims: 0", said)
        self.assertRegex(said, r"construction_square +3 cells x +3 replications, grid: "
                               r"behaviour \(2\) x delta_theta_deg \(2\)")
        self.assertRegex(said, r"drawn +4 cells x +3 replications, latin_hypercube: "
                               r"period_s x behaviour \(2\)")
        self.assertRegex(said, r"a study of 652 trials in \d+ cells; tables: \d+, claims: 113")
        self.assertIn("ok.toml: a scenario of 4 vehicles", said)
        self.sweep(out="out")
        self.assertEqual(len(self.tables()), 2 * 3)  # as .tex, .csv and .md

    def test_check_finds_what_a_sweep_would_refuse(self):
        for what, right, wrong, said in [
                ("a factor", "delta_theta_deg\"\nvalues", "delta_thta_deg\"\nvalues",
                 ["bad.toml:11:", 'no option "delta_thta_deg"']),
                ("a value in the last cell", "[10, 45]", "[10, 450]",
                 ["bad.toml:13:", "is 450", "in the cell"]),
                ("a table", 'columns = ["behaviour"]', 'columns = ["behavior"]',
                 ["bad.toml:21:", "behavior", "did you mean"]),
                ("a base", '"construction_square"', '"nowhere"', ["bad.toml:", '"nowhere"'])]:
            with self.subTest(what):
                self.assertIn(right, STUDY)
                self.write("bad.toml", STUDY.replace(right, wrong))
                self.assert_complains(self.shoal("check", "bad.toml"), 2, said)
        self.assert_complains(self.shoal("check", "thesis_chapter6"), 2, ["thesis_chapter5"])


if __name__ == "__main__":
    desk.main()
