"""Trials and studies run from Python are those of the program, bit for bit.

    PYTHONPATH=build/ci/python python3 python_runs_test.py SHOAL
"""

import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import time

import desk
import numpy
import shoal
import xarray
from python_desk import PythonDesk, Until
from study_desk import SHORT, STUDY


class Trials(PythonDesk):
    def test_a_run_gives_the_bits_of_the_program(self):
        sets = {"trial.duration_s": 1200, "behaviour.kind": "assignment_registration"}
        summary = self.run_trial("redsea_square", "--seed", "7",
                                 *(word for key, value in sets.items()
                                   for word in ("--set", f"{key}={value}")))
        dataset, measures = shoal.run("redsea_square", sets, seed=7)
        self.assertEqual(measures, summary["measures"])
        vehicles, series = (xarray.load_dataset(self.desk / "out" / name, decode_times=False)
                            for name in ("run.nc", "series.nc"))
        self.assertTrue(dataset.identical(vehicles.reset_coords(["x", "y", "depth"]).merge(series)))
        self.assertLessEqual({"x", "y", "speed", "quality"}, set(dataset.data_vars))
        self.assertEqual(dict(dataset.sizes)["vehicle"], 20)

    def test_threads_recording_and_folders_change_no_number(self):
        plain = shoal.run("redsea_square", {"trial.duration_s": 600}).measures
        self.assertEqual(shoal.run("redsea_square", {"trial.duration_s": 600}, threads=2,
                                   record=False).measures, plain)
        run = shoal.run("redsea_square", {"trial.duration_s": 600}, out=self.desk / "here",
                        report=True)
        self.assertEqual(run.measures, plain)
        self.assertEqual({f.name for f in (self.desk / "here").iterdir()},
                         {"scenario.toml", "run.nc", "series.nc", "summary.json", "report.html"})

    def test_a_folder_may_have_blanks_and_backslashes_in_its_name(self):
        settings = {"trial.duration_s": 60}
        plain = shoal.run("construction_square", settings)
        run = shoal.run("construction_square", settings, out=self.desk / "a\\b c")
        self.assertTrue(run.dataset.identical(plain.dataset))
        self.assertTrue((self.desk / "a\\b c" / "run.nc").exists())

    def test_scenarios_may_be_names_files_and_dicts(self):
        whole = shoal.scenario("construction_square", {"trial.duration_s": 300})
        self.assertEqual(whole["trial"]["duration_s"], 300)
        by_dict = shoal.run(whole).measures
        by_name = shoal.run("construction_square", {"trial": {"duration_s": 300}}).measures
        self.assertEqual(by_dict, by_name)
        self.write("own.toml", 'plan.square = { rows = 2, columns = 2 }\ntrial.duration_s = 60\n')
        by_file = shoal.run(self.desk / "own.toml").measures
        self.assertEqual(by_file, shoal.run({"plan.square": {"rows": 2, "columns": numpy.int64(2)},
                                             "trial.duration_s": numpy.float64(60)}).measures)

    def test_settings_are_inherited(self):
        self.assertNotIn("inherits", shoal.scenario("construction_square"))
        whole = shoal.scenario("construction_square", {"inherits": "program"})
        self.assertEqual(whole["planner"]["update"], "tick")
        self.assertEqual(whole["plan"]["kind"], "square")
        self.write("mine.toml", 'inherits = "text"\n[ping]\nperiod_s = 11\n')
        own = shoal.scenario({"inherits": self.desk / "mine.toml", "trial": {"duration_s": 60}})
        self.assertEqual((own["ping"]["period_s"], own["planner"]["update"]), (11.0, "ping"))
        with self.assertRaisesRegex(shoal.InputError, 'did you mean "program"'):
            shoal.run("construction_square", {"inherits": "progam"})

    def test_errors_say_what_the_program_says(self):
        for sets in ({"behaviour.knd": "x"}, {"trial.seed": "many"}, {"plan.square.rows": 0},
                     {"ping.range_m": -1}):
            (key, value), = sets.items()
            text = json.dumps(value)
            done = self.shoal("run", "redsea_square", "--set", f"{key}={text}")
            sentence = done.stderr.removeprefix(f"shoal: --set {key}={text}: ").rstrip("\n")
            with self.assertRaises(shoal.InputError) as refused:
                shoal.run("redsea_square", sets)
            self.assertEqual(str(refused.exception), sentence)
        with self.assertRaises(shoal.InputError) as refused:
            shoal.run("nowhere")
        self.assertIn('no file "nowhere"', str(refused.exception))
        with self.assertRaisesRegex(shoal.InputError, "a NoneType, which no option takes"):
            shoal.run("redsea_square", {"trial.seed": None})
        with self.assertRaises(shoal.SystemError):
            shoal.run("redsea_square", {"trial.duration_s": 10}, out="/proc/here")

    def test_other_threads_go_on_during_a_run(self):
        ticks = []
        over = threading.Event()

        def tick():
            while not over.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        began = time.monotonic()
        shoal.run("redsea_square", {"behaviour.kind": "assignment_registration"}, record=False)
        ended = time.monotonic()
        over.set()
        thread.join()
        during = [t for t in ticks if began < t < ended]
        self.assertGreater(len(during), 20)

    def test_threads_may_run_trials_at_once(self):
        settings = {"trial.duration_s": 120}
        alone = shoal.run("redsea_square", settings, seed=1)
        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            runs = list(pool.map(lambda _: shoal.run("redsea_square", settings, seed=1), range(24)))
        for run in runs:
            self.assertEqual(run.measures, alone.measures)
            self.assertTrue(run.dataset.identical(alone.dataset))

    def test_a_long_run_is_interrupted_and_says_how_far_it_is(self):
        self.write("long.py", """
import shoal
def far(now):
    assert now["duration_s"] == 1e8 and 0 < now["time_s"] < 1e8 and now["elapsed_s"] > 0
    print("on its way", flush=True)
shoal.run("construction_square", {"trial.duration_s": 1e8, "trial.record_every_s": 0}, progress=far)
""")
        self.assert_interrupted("long.py")

    def test_a_cost_of_single_numbers_hints_at_arrays_in_a_long_run(self):
        law = shoal.potential(lambda r, s: (r - s)**2 / s)
        with self.assertWarnsRegex(RuntimeWarning, "batch=True"), self.assertRaises(StopIteration):
            shoal.run("construction_hexagonal",
                      {"behaviour.kind": "attraction_repulsion", "trial.duration_s": 1e8,
                       "trial.record_every_s": 0,
                       "behaviour.attraction_repulsion.potential": law}, progress=Until(8))

    def test_values_that_no_option_takes(self):
        deep = 1
        for _ in range(3000):
            deep = [deep]
        endless = {}
        endless["trial"] = endless
        for wrong, why in [
            ({"trial": {"seed": 2**70}}, "more than 64 bits"),
            ({"trial": {"seed": deep}}, "nested more than 100 deep"),
            (endless, "contains itself"),
            ({".".join("a" * 60000): 1}, "a key has 60000 parts"),
        ]:
            with self.assertRaisesRegex(shoal.InputError, why):
                shoal.run("redsea_square", wrong)

    def test_counts_are_whole_numbers(self):
        for seed in (1.9, "7", True, numpy.float64(3)):
            with self.assertRaisesRegex(shoal.InputError, "seed is .*; it takes an integer"):
                shoal.run("construction_square", {"trial.duration_s": 10}, seed=seed)
        shoal.run("construction_square", {"trial.duration_s": 10}, seed=numpy.int32(3))
        for option, wrong in (("replications", -1), ("replications", 1.5), ("jobs", 0), ("jobs", "2")):
            with self.assertRaisesRegex(shoal.InputError, f"{option} is {wrong!r}; it takes"):
                shoal.sweep(STUDY, self.desk / "out", **{option: wrong})
        self.assertFalse((self.desk / "out").exists())

    def test_arguments_of_another_kind_are_refused_by_name(self):
        refused = {
            "threads": [(True, "takes an integer"), (numpy.True_, "takes an integer"), (0, "1 to 1024"),
                        (1_000_000, "1 to 1024")],
            "record": [(None, "True or False"), (1, "True or False")],
            "report": [("no", "True or False"), (True, "report is True, and out is None")],
            "out": [("", "out is empty"), (5, "out is 5; it takes a path")],
            "progress": [(5, "takes a function, or None"), ("x", "takes a function, or None")],
        }
        for name, wrongs in refused.items():
            for wrong, says in wrongs:
                with self.subTest(name=name, wrong=wrong):
                    with self.assertRaisesRegex(shoal.InputError, f"^{name} is .*{says}|^{says}"):
                        shoal.run("construction_square", {"trial.duration_s": 10}, **{name: wrong})
        for name, wrong, says in (("jobs", 1_000_000, "1 to 1024"), ("jobs", True, "takes an integer"),
                                  ("progress", 5, "takes a function, or None"), ("out", "", "out is empty"),
                                  ("retry_failed", None, "True or False")):
            with self.subTest(name=name, wrong=wrong):
                with self.assertRaisesRegex(shoal.InputError, f"^{name} is .*{says}|^{says}"):
                    shoal.sweep(STUDY, **{"out": self.desk / "out", name: wrong})
        self.assertFalse((self.desk / "out").exists())

    def test_text_that_is_no_unicode_is_refused(self):
        for wrong in ("\udc80", {"title": "\udc80"}, {"\udc80": 1}):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(shoal.InputError, "valid Unicode"):
                shoal.run(wrong)
        with self.assertRaisesRegex(shoal.InputError, "^out is .*valid Unicode"):
            shoal.run("construction_square", {"trial.duration_s": 10}, out="a\udc80")

    def test_arguments_that_no_conversion_takes_are_refused_by_name(self):
        for name, wrong in (("threads", "2"), ("threads", 2**63), ("record", "yes"), ("set", 5), ("seed", 2**70)):
            with self.subTest(name=name), self.assertRaisesRegex(shoal.InputError, f"^{name} is "):
                shoal.run("construction_square", **{"set": {"trial.duration_s": 10}, name: wrong})
        with self.assertRaisesRegex(shoal.InputError, "^scenario is 5; it takes a name, a file, or a dict"):
            shoal.run(5)
        for name, wrong in (("rerun_changed", "x"), ("replications", 2**63), ("jobs", 1.5)):
            with self.subTest(name=name), self.assertRaisesRegex(shoal.InputError, f"^{name} is "):
                shoal.sweep(STUDY, self.desk / "out", **{name: wrong})
        with self.assertRaisesRegex(shoal.InputError, "replications"):
            self.write("study.toml", STUDY)
            shoal.sweep(self.desk / "study.toml", self.desk / "out", replications=2**62)
        self.assertFalse((self.desk / "out").exists())


class Studies(PythonDesk):
    def test_a_sweep_gives_the_tables_of_the_program(self):
        self.write("study.toml", STUDY)
        self.assertEqual(self.shoal("sweep", "study.toml", "--out", "program").returncode, 0)
        counts = []
        frame = shoal.sweep(self.desk / "study.toml", self.desk / "python", jobs=2,
                            progress=counts.append)
        self.assertEqual((len(frame), counts[-1]["done"]), (9, 9))
        for file in (self.desk / "program" / "tables").iterdir():
            self.assertEqual((self.desk / "python" / "tables" / file.name).read_bytes(),
                             file.read_bytes(), file.name)
        again = shoal.sweep(self.desk / "study.toml", self.desk / "python")
        self.assertTrue(again.equals(frame))
        table = shoal.tables(self.desk / "python")["energy"]
        self.assertIn("\\begin{table}", table.print("latex"))
        self.assertIn("<table>", table._repr_html_())
        self.assertEqual(len(table.rows), 3)

    def test_a_study_may_be_a_dict(self):
        frame = shoal.sweep({"scenario": "construction_square", "replications": 2,
                             "set": {"trial.duration_s": 60},
                             "factor": [{"key": "ping.period_s", "values": [10, 30]}]},
                            self.desk / "out")
        self.assertEqual(sorted(frame.period_s), [10, 10, 30, 30])
        dataset = shoal.study_dataset(self.desk / "out")
        self.assertEqual(dict(dataset.energy_mean_wh.sizes), {"period_s": 2, "replication": 2})
        self.assertTrue((shoal.study_report(self.desk / "out")).exists())
        with self.assertRaisesRegex(shoal.InputError, "there is no group 'north'; known are none"):
            shoal.study_dataset(self.desk / "out", "north")

    def test_a_sweep_can_be_interrupted_and_goes_on(self):
        self.write("study.toml", SHORT)

        def stop(counts):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            shoal.sweep(self.desk / "study.toml", self.desk / "out", jobs=1, progress=stop)
        self.assertEqual(len(shoal.sweep(self.desk / "study.toml", self.desk / "out")), 9)

    def test_a_sweep_is_interrupted_within_a_trial(self):
        self.write("study.toml", 'scenario = "construction_square"\n'
                                 'set = { trial.duration_s = 1e8 }\nreplications = 2\n')
        self.write("long.py", """
import shoal
shoal.sweep("study.toml", "out", jobs=2, progress=lambda now: print("on its way", flush=True))
""")
        self.assert_interrupted("long.py")


class Catalogue(PythonDesk):
    def test_names_and_options_are_those_of_the_program(self):
        listed = self.shoal("list").stdout
        for family, members in shoal.catalogue().items():
            for member in members:
                if (family, member) != ("potential", "python"):
                    self.assertIn(f"  {member}", listed)
        options = shoal.options("behaviour", "rigid_registration")
        self.assertIn("behaviour.rigid_registration.ownship_weight", set(options.key))
        self.assertIn("energy_mean_wh", shoal.measures().index)
        with self.assertRaisesRegex(shoal.InputError, "no family"):
            shoal.catalogue("fish")

    def test_the_stubs_say_what_is_there(self):
        package = pathlib.Path(shoal.__file__).parent.parent
        with tempfile.TemporaryDirectory() as work:
            settings = pathlib.Path(work, "mypy.ini")
            settings.write_text("[mypy]\nignore_missing_imports = True\n")
            allowed = pathlib.Path(work, "allowed")  # pybind11's classes have a class of their own
            allowed.write_text(r"shoal\._shoal\.\w+" "\n" r"shoal\._shoal\.(Command|Solution|Table|SolverProblem|World"
                               r"|Neighbourhoods?)\.__init__"
                               "\n")
            env = {"MYPYPATH": str(package), "PYTHONPATH": str(package), "PATH": "/usr/bin:/bin",
                   "HOME": work}
            for check in (["mypy.stubtest", "shoal._shoal", "--mypy-config-file", settings,
                           "--ignore-positional-only", "--ignore-unused-allowlist", "--allowlist",
                           allowed],
                          ["mypy", "--config-file", settings, "-p", "shoal"]):
                done = subprocess.run([sys.executable, "-m", *map(str, check)], cwd=work, env=env,
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    desk.main()
