"""shoal figures as its user sees them: made for every kind of run, the same twice, and bad input.

    python3 figures_test.py SHOAL
"""

import math
import pathlib
import shutil
import subprocess
import sys

import desk
import netCDF4
from desk import Desk
from study_desk import SHORT

COMPARISON = """
[[comparison]]
name = "difference"
factor = "delta_theta_deg"
reference = "10"
measures = ["energy_mean_wh"]
"""

TIME = {"speeds", "energy", "energy_by_distance", "efficiency", "thrust"}
FIGURES = {"potentials_channel": {*TIME, "trajectories", "quality", "passage", "filter_lag"},
           "potentials_clutter": {*TIME, "trajectories", "quality", "passage", "filter_lag"},
           "potentials_basin": {*TIME, "trajectories", "basin", "passage"},
           "redsea_square": {*TIME, "trajectories", "quality", "current"},
           "construction_hexagonal": {*TIME, "trajectories", "quality", "potential", "cost_surface"}}
REPEL = ("--set", "behaviour.kind=attraction_repulsion")
BEGINS = {".pdf": b"%PDF-", ".svg": b"<?xml"}


def write_record(file, dimensions=(2, 3), **numbers):
    """run.nc of two vehicles at three instants, or of other dimensions; of which some numbers are
    these, and those that are None are left out."""
    numbers = {**dict.fromkeys(("x", "y", "speed", "target_reason"), 0), "time": [0, 1, 2], **numbers}
    with netCDF4.Dataset(file, "w") as record:
        for name, size in zip(("vehicle", "time"), dimensions):
            record.createDimension(name, size or None)  # None may be none yet
        for name, value in numbers.items():
            if value is None:
                continue
            along = ("time",) if name == "time" else ("vehicle", "time")
            variable = record.createVariable(name, "f4", along, chunksizes=len(along) * (1,))
            if dimensions == (2, 3):
                variable[:] = value
            if name == "target_reason":
                variable.flag_values = [0, 1, 2, 3, 4]


class Figures(Desk):
    def recorded(self, scenario, *sets):
        done = self.shoal("run", scenario, "--set", "trial.duration_s=40", *sets, "--out", scenario)
        self.assertEqual(done.returncode, 0, done.stderr)

    def drawn(self, folder, *arguments):
        done = self.shoal("figures", folder, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {pathlib.Path(file.strip()) for file in
                done.stdout.removeprefix("written: ").split(",")}

    def test_every_kind_of_run_has_its_figures(self):
        for scenario, names in FIGURES.items():
            self.recorded(scenario, *(REPEL if "potential" in names else ()))
            files = self.drawn(scenario)
            self.assertEqual({file.stem for file in files}, names)
            for file in files:
                self.assertTrue((self.desk / file).read_bytes().startswith(BEGINS[file.suffix]))
            self.assertEqual({file.name for file in files},
                             {file.name for file in (self.desk / scenario / "figures").iterdir()})

    def test_a_folder_may_have_blanks_and_backslashes_in_its_name(self):
        self.recorded("potentials_channel", "--no-report")
        (self.desk / "potentials_channel").rename(self.desk / "a\\b c")
        self.assertEqual(self.drawn("a\\b c", "--only", "speeds"),
                         {pathlib.Path("a\\b c/figures") / f"speeds.{kind}" for kind in ("pdf", "svg")})

    def test_the_same_run_gives_the_same_bytes(self):
        self.recorded("potentials_clutter")
        first = {file: (self.desk / file).read_bytes() for file in self.drawn("potentials_clutter")}
        for file in self.drawn("potentials_clutter"):
            self.assertEqual((self.desk / file).read_bytes(), first[file], file)

    def test_what_is_no_longer_drawn_goes_and_files_of_others_stay(self):
        self.recorded("redsea_square")
        self.drawn("redsea_square")
        folder = self.desk / "redsea_square" / "figures"
        drawn = {file.name for file in folder.iterdir()}
        for ending in ("pdf", "svg"):
            shutil.copy(folder / f"energy.{ending}", folder / f"earlier.{ending}")
            (folder / f"own.{ending}").write_text("mine")
        self.drawn("redsea_square", "--only", "energy")
        self.drawn("redsea_square", "--out", self.desk / "redsea_square/figures")
        self.assertIn("earlier.pdf", {file.name for file in folder.iterdir()})
        self.drawn("redsea_square")
        self.assertEqual({file.name for file in folder.iterdir()}, drawn | {"own.pdf", "own.svg"})

    def test_fonts_are_in_the_file(self):
        self.recorded("redsea_square")
        self.drawn("redsea_square", "--only", "energy", "--columns", "2", "--out", "two")
        fonts = subprocess.run(["pdffonts", self.desk / "two/energy.pdf"], check=True, text=True,
                               capture_output=True).stdout.splitlines()[2:]
        self.assertTrue(fonts)
        self.assertTrue(all(" yes " in font for font in fonts), fonts)
        pages = subprocess.run(["pdfinfo", self.desk / "two/energy.pdf"], check=True, text=True,
                               capture_output=True).stdout
        width = float(pages.split("Page size:")[1].split()[0])
        self.assertAlmostEqual(width / 72 * 2.54, 17.4, places=1)

    def test_a_study_has_a_figure_of_every_table_with_numbers(self):
        self.write("study.toml", SHORT + COMPARISON)
        done = self.sh("$SHOAL sweep study.toml --out out")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("written: out/report.html\nwritten: out/figures, each as .pdf and .svg\n",
                      done.stdout)
        self.assertEqual(self.pictures_of_page(), 3)
        shutil.rmtree(self.desk / "out" / "figures")
        files = self.drawn("out")
        self.assertEqual({file.stem for file in files},
                         {"energy", "against_time", "difference"})
        self.assertEqual(self.drawn("out", "--only", "energy"),
                         {file for file in files if file.stem == "energy"})
        done = self.shoal("report", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.pictures_of_page(), 3)

    def pictures_of_page(self):
        return (self.desk / "out" / "report.html").read_text().count("data:image/svg+xml;base64,")

    def test_a_curve_has_the_numbers_of_its_table(self):
        sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "analysis/reporting/figures"))
        import matplotlib
        matplotlib.use("Agg")
        import of_study
        import style
        from stored_study import StudyTable

        self.enterContext(style.page(1))
        rows = [{"group": g, "period_s": p, "square_energy_mean_wh": v, "square_energy_mean_wh_low": low,
                 "square_energy_mean_wh_high": high, "square_energy_mean_wh_n": "3"}
                for g, p, v, low, high in (("a", "30", "5", "4", "7"), ("a", "5", "2", "1", "3"),
                                           ("a", "10", "3", "2", "4"), ("b", "5", "8", "8", "8"))]
        table = StudyTable("t", "", rows)
        self.assertEqual((table.labels, table.numbers), (["group", "period_s"], ["square_energy_mean_wh"]))
        axes, = of_study.figure_of(table, {"measures": ["energy_mean_wh"]}).axes
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("Period (s)", "Energy mean (Wh)"))
        curve, other = axes.lines
        self.assertEqual((curve.get_label(), other.get_label()), ("a, square", "b, square"))
        self.assertEqual(curve.get_xydata().tolist(), [[5, 2], [10, 3], [30, 5]])
        band = axes.collections[0].get_paths()[0].vertices
        self.assertEqual({tuple(corner) for corner in band.tolist()} - {(5, 2)},
                         {(5, 1), (10, 2), (30, 4), (30, 7), (10, 4), (5, 3)})

    def test_a_factor_keeps_its_name_where_numbers_have_it(self):
        sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "analysis/reporting/figures"))
        from long_form import numbers_of
        from stored_study import StudyTable

        rows = [{"measure": "energy mean (Wh)", "difference_label": "30", "difference": "2",
                 "difference_plus_minus": "1", "difference_n": "3"}]
        number, = numbers_of(StudyTable("t", "", rows), {})
        self.assertEqual((number.levels, number.value), ({"difference": "30"}, 2.0))

    def test_indices_of_a_sensitivity(self):
        self.write("study.toml", """scenario = "construction_square"
set = { trial.duration_s = 30 }
replications = 1
design = { kind = "saltelli", saltelli = { base_samples = 8 } }
[[factor]]
key = "ping.period_s"
range = [5, 30]
[[factor]]
key = "guidance.drift.drifting_radius_m"
range = [15, 40]
[[sensitivity]]
name = "indices"
measures = ["energy_mean_wh"]
""")
        done = self.shoal("sweep", "study.toml", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("indices", {file.stem for file in self.drawn("out")})

    def test_performance_profiles(self):
        self.shoal("run", "construction_hexagonal", "--set", "behaviour.kind=attraction_repulsion",
                   "--set", "trial.duration_s=300", "--record-problems", "problems.jsonl", "--out",
                   "out")
        done = self.shoal("solve", "problems.jsonl", "--solvers", "newton,nlopt.lbfgs", "--profiles",
                          "profiles.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({str(file) for file in self.drawn("profiles.csv")},
                         {f"figures/{name}.{kind}" for name in ("profiles", "profiles_progress")
                          for kind in ("pdf", "svg")})
        self.assertEqual({str(file) for file in self.drawn("profiles_progress.csv")},
                         {"figures/profiles_progress.pdf", "figures/profiles_progress.svg"})

    def test_closed_forms_have_profiles_and_no_progress(self):
        self.shoal("run", "construction_square", "--set", "trial.duration_s=60",
                   "--record-problems", "problems.jsonl", "--out", "out")
        done = self.shoal("solve", "problems.jsonl", "--solvers", "procrustes", "--profiles", "p.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({str(file) for file in self.drawn("p.csv")}, {"figures/p.pdf", "figures/p.svg"})

    def test_says_what_is_wrong(self):
        self.assert_complains(self.shoal("figures", "."), 2, ["has no scenario.toml"])
        self.assert_complains(self.shoal("figures"), 2, ["required: what", "--help"])
        self.recorded("potentials_channel")
        self.assert_complains(self.shoal("figures", "potentials_channel", "--only", "spedes"), 2,
                              ['"spedes"', "speeds"])
        self.assert_complains(self.shoal("figures", "potentials_channel", "--only", "basin"), 2,
                              ["nothing that these figures show"])
        record = self.desk / "potentials_channel/run.nc"
        record.write_bytes(record.read_bytes()[:1000])
        self.assert_complains(self.shoal("figures", "potentials_channel"), 2, ["is damaged"])
        record.unlink()
        self.assert_complains(self.shoal("figures", "potentials_channel"), 2, ["has no run.nc"])

    def test_a_record_that_shoal_never_wrote(self):
        self.recorded("potentials_channel", "--no-report")
        for numbers, says in (({"x": 1e30}, "x is 1e+30 somewhere"),
                              ({"time": [0, 1, math.nan]}, "time is nan somewhere"),
                              ({"target_reason": 7}, "target_reason is 7 somewhere"),
                              ({"time": None}, "is none that shoal run wrote"),
                              ({"speed": None}, "has no speed by vehicle and time"),
                              ({"dimensions": (0, 3)}, "holds no vehicle"),
                              ({"dimensions": (2, 0)}, "holds no instant"),
                              ({"dimensions": (2, 1 << 40)}, "more than 268435456 numbers")):
            with self.subTest(says):
                write_record(self.desk / "potentials_channel/run.nc", **numbers)
                self.assert_complains(self.shoal("figures", "potentials_channel"), 2,
                                      ["potentials_channel/run.nc", says])
        write_record(self.desk / "potentials_channel/run.nc")
        self.drawn("potentials_channel", "--only", "speeds")

    def test_what_cannot_be_read(self):
        long = 300 * "a"
        self.assert_complains(self.shoal("figures", long), 2, ["cannot read " + long, "too long"])
        self.write("study/study.toml", b"title = '\xff'\n")
        self.assert_complains(self.shoal("figures", "study"), 2, ["study is damaged"])

    def test_a_full_disk(self):
        self.recorded("potentials_channel", "--no-report")
        done = self.sh("ulimit -f 2; $SHOAL figures potentials_channel --only speeds --out out")
        self.assert_complains(done, 1, ["cannot write out", "too large"])
        self.assertEqual(list((self.desk / "out").iterdir()), [])

    def test_empty_arguments(self):
        for arguments in (("",), (".", "--out", ""), (".", "--only", ""), (".", "--columns", "")):
            self.assert_complains(self.shoal("figures", *arguments), 2, ["is empty", "--help"])
        self.assert_complains(self.shoal("figures", ".", "--columns", "x"), 2, ["int", "'x'"])

    def test_a_folder_that_takes_nothing(self):
        self.recorded("potentials_channel")
        (self.desk / "file").write_text("")
        self.assert_complains(self.shoal("figures", "potentials_channel", "--out", "file"), 1,
                              ["cannot write file"])
        shutil.rmtree(self.desk / "potentials_channel")


if __name__ == "__main__":
    desk.main()
