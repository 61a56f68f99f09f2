"""The Python package does what the program does, bit for bit.

    PYTHONPATH=build/ci/python python3 python_test.py SHOAL
"""

import concurrent.futures
import copy
import json
import math
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

import desk
import numpy
import shoal
import xarray
from desk import Desk
from study_desk import SHORT, STUDY

REPELLED = {"behaviour.kind": "attraction_repulsion", "trial.duration_s": 900}
LAW = "behaviour.attraction_repulsion.potential"


def thesis(r, s):
    return s**3 / (2 * r**2) + r - 3 * s


class Until:
    """Progress that ends a run after so many seconds."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __call__(self, now):
        if now["elapsed_s"] > self.seconds:
            raise StopIteration


class Trials(Desk):
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
        with subprocess.Popen([sys.executable, "long.py"], cwd=self.desk, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
            try:
                self.assertEqual(running.stdout.readline(), "on its way\n")
                running.send_signal(signal.SIGINT)
                _, complaint = running.communicate(timeout=120)
            finally:
                running.kill()
        self.assertIn("KeyboardInterrupt", complaint)

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


class Potentials(Desk):
    def test_one_law_in_four_forms_gives_one_trajectory(self):
        forms = [shoal.potential("thesis"), shoal.potential(thesis),
                 shoal.potential(thesis, batch=True),
                 shoal.potential("expression", formula="s^3/(2*r^2) + r - 3*s")]
        # Commands in steps: targets differ by the solver's tolerance, and the vehicles do not.
        steps = {"swarm.vehicle.drifter.speed_step_m_s": 0.2,
                 "swarm.vehicle.drifter.course_step_deg": 1}
        runs = [shoal.run("construction_hexagonal", {**REPELLED, **steps, LAW: form}, seed=3)
                for form in forms]
        for run in runs[1:]:
            numpy.testing.assert_allclose(run.dataset.x, runs[0].dataset.x, atol=1e-6)
            numpy.testing.assert_allclose(run.dataset.y, runs[0].dataset.y, atol=1e-6)

    def test_values_and_derivatives_are_those_of_cpp(self):
        r = numpy.geomspace(0.2, 5000, 2001)
        laws = {"s^3/(2*r^2) + r - 3*s": thesis,
                "(r - s)^2/s + 5*exp(-r/20)": lambda r, s: (r - s)**2 / s + 5 * numpy.exp(-r / 20),
                "log(r)*sin(r/s) + tanh(s/r)":
                    lambda r, s: numpy.log(r) * numpy.sin(r / s) + numpy.tanh(s / r),
                "sqrt(r + s) + r^1.5/cosh(r/s)":
                    lambda r, s: numpy.sqrt(r + s) + r**1.5 / numpy.cosh(r / s),
                "atan(r/s) + s/r - 2": lambda r, s: numpy.arctan(r / s) + s / r - 2}
        for formula, law in laws.items():
            exact = shoal.potential("expression", formula=formula).derivatives(r, 300.0)
            # The unit of each order: what the largest of value, r f' and r^2 f'' makes of it.
            scale = sum(numpy.abs(exact[k]) * r**k for k in range(3))
            # A table promises value and slope to 1e-9; between its nodes the curvature errs by two
            # powers of their distance more.
            for batch, tolerances in ((False, [1e-12] * 3), (True, [1e-9, 1e-9, 1e-7])):
                found = shoal.potential(law, batch=batch).derivatives(r, 300.0)
                for k in range(3):
                    worst = numpy.max(numpy.abs(found[k] - exact[k]) * r**k / scale)
                    self.assertLess(worst, tolerances[k], f"{formula}, order {k}, batch={batch}")

    def test_derivatives_may_be_given(self):
        law = shoal.potential(lambda r, s: math.exp(-r / s), slope=lambda r, s: -math.exp(-r / s) / s,
                              curvature=lambda r, s: math.exp(-r / s) / s**2)
        self.assertEqual(law.derivatives(300.0, 300.0)[1], -math.exp(-1) / 300)

    def test_branches_and_constants(self):
        law = shoal.potential(lambda r, s: 0 * s + 3)
        self.assertEqual(law.derivatives(10.0, 300.0), (3.0, 0.0, 0.0))
        law = shoal.potential(lambda r, s: numpy.where(r < s, (r - s)**2, 0 * r))
        self.assertEqual(law.derivatives([290.0, 310.0], 300.0)[1].tolist(), [-20.0, 0.0])

    def test_what_cannot_be_used_is_refused(self):
        with self.assertRaisesRegex(shoal.InputError, "cannot be differentiated"):
            shoal.potential(lambda r, s: math.exp(r))
        with self.assertRaisesRegex(shoal.InputError, "too rough"):
            shoal.potential(lambda r, s: abs(r - s), batch=True).derivatives(1.0, 300.0)
        with self.assertRaisesRegex(shoal.InputError, "slope and curvature, or neither"):
            shoal.potential(thesis, slope=thesis)
        with self.assertRaisesRegex(shoal.InputError, 'no potential "spring"'):
            shoal.potential("spring")

    def test_a_law_returns_real_finite_numbers_in_either_form(self):
        def law(**wrong):
            parts = {"value": lambda r, s: r * 0 + 1, "slope": lambda r, s: r * 0,
                     "curvature": lambda r, s: r * 0, **wrong}
            return parts["value"], {"slope": parts["slope"], "curvature": parts["curvature"]}

        wrongs = ((lambda r, s: r * math.nan, "nan|not finite"), (lambda r, s: r * math.inf, "inf|not finite"),
                  (lambda r, s: None, "returned None"), (lambda r, s: "1", "returned (text|an array of)"),
                  (lambda r, s: r * 1j, "complex"))
        for part in ("value", "slope", "curvature"):
            for wrong, says in wrongs:
                for batch in (False, True):
                    value, derivatives = law(**{part: wrong})
                    potential = shoal.potential(value, **derivatives, batch=batch, version="1")
                    with self.subTest(part=part, says=says, batch=batch):
                        with self.assertRaisesRegex(shoal.InputError, says):
                            shoal.run("construction_hexagonal", {**REPELLED, LAW: potential})

    def test_an_array_of_another_shape_or_with_masked_numbers_is_refused(self):
        for wrong, says in ((lambda r, s: numpy.zeros(3), r"shape \(3,\) for distances of shape"),
                            (lambda r, s: numpy.ma.masked, "returned a masked array")):
            for batch in (False, True):
                with self.subTest(says=says, batch=batch), self.assertRaisesRegex(shoal.InputError, says):
                    shoal.potential(wrong, batch=batch).derivatives(1.0, 300.0)

    def test_what_a_conversion_raises_comes_out_unchanged(self):
        class Odd:
            def __float__(self):
                raise KeyError("mine")

        law = shoal.potential(lambda r, s: Odd(), slope=lambda r, s: 0.0, curvature=lambda r, s: 0.0,
                              version="1")
        with self.assertRaisesRegex(KeyError, "mine"):
            shoal.run("construction_hexagonal", {**REPELLED, LAW: law})

    def test_what_a_cost_raises_comes_out_unchanged(self):
        def broken(r, s):
            raise KeyError("mine")

        law = shoal.potential(broken, slope=broken, curvature=broken)
        with self.assertRaisesRegex(KeyError, "mine"):
            shoal.run("construction_hexagonal", {**REPELLED, LAW: law}, threads=2)

    def test_a_changed_function_is_another_scenario(self):
        def law(r, s):
            return (r - s)**2

        first = shoal.potential(law)._setting_()
        same = shoal.potential(law)._setting_()

        def law(r, s):  # noqa: F811
            return (r - s)**2 / s

        other = shoal.potential(law)._setting_()
        self.assertEqual(first, same)
        self.assertNotEqual(first["python"]["source"], other["python"]["source"])

    def test_so_is_one_that_uses_something_else(self):
        def made(helper, table):
            def law(r, s):
                return helper(r - s) + table[-500] * r
            return shoal.potential(law)._setting_()["python"]["source"]

        table = numpy.zeros(2000)
        changed = table.copy()
        changed[-500] = 1.0  # numpy's text of both is the same
        sources = [made(lambda d: d**2, table), made(lambda d: d**4, table),
                   made(lambda d: d**2, changed)]
        self.assertEqual(len(set(sources)), 3)
        self.assertEqual(made(lambda d: d**2, table.copy()), sources[0])
        lock = threading.Lock()
        with self.assertRaisesRegex(shoal.InputError, "give a version"):
            made(lambda d: d if lock else 2 * d, table)

    def test_the_hash_is_the_same_in_another_process(self):
        program = ("import shoal\ndef helper(d): return d**2\ndef law(r, s): return helper(r - s)\n"
                   "print(shoal.potential(law)._setting_())")
        said = {subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                               check=True).stdout for _ in range(2)}
        self.assertEqual(len(said), 1)


class Planning(Desk):
    def setUp(self):
        super().setUp()
        self.plan = shoal.Plan([[0, 0], [100, 0], [0, 100]], ["anna", "bela", "cyra"])

    def ping(self, slot, place, position=(0, 0), time_s=1.0):
        dx, dy = place[0] - position[0], place[1] - position[1]
        return shoal.Ping(time_s=time_s, range_m=math.hypot(dx, dy), bearing_rad=math.atan2(dy, dx),
                          slot=slot)

    def test_a_planner_leads_to_the_own_slot(self):
        # Bela and cyra sit where the plan, turned by a quarter, puts them; anna is 30 m off.
        planner = shoal.Planner(self.plan, "pairwise_referencing", "anna")
        position = numpy.array([1030.0, 500.0])
        planner.receive(self.ping(1, (1000, 600), position), position)
        planner.receive(self.ping(2, (900, 500), position), position)
        numpy.testing.assert_allclose(planner.plan(2.0, position), [-30, 0], atol=1e-9)
        numpy.testing.assert_allclose(planner.target(position + [5, 0]), [-35, 0], atol=1e-9)
        self.assertEqual((planner.reason, planner.force), ("placed", None))

    def test_a_vehicle_that_hears_no_other_holds(self):
        planner = shoal.Planner(self.plan, "rigid_registration", "bela")
        self.assertEqual(planner.plan(1.0, [7, 7]).tolist(), [0, 0])
        self.assertEqual(planner.reason, "no_neighbour")

    def test_the_filter_smooths_and_lags(self):
        tracks = shoal.PingFilter({"timeout_s": 120})
        for k in range(5):  # runs away at 1 m/s, heard every 30 s
            tracks.receive(self.ping(1, (100 + 30 * k, 0), time_s=30.0 * k), [0, 0])
        (east, north), = tracks.neighbours(120.0, [0, 0])
        # Weights 1, 3/4, 1/2, 1/4 of 220, 190, 160 and 130 m (Rypkema 2015, Alg. 3): 190 m.
        self.assertAlmostEqual(east, 190.0)
        self.assertAlmostEqual(north, 0.0)

    def test_the_current_of_a_scenario(self):
        sets = {"current.kind": "uniform", "current.uniform": {"u_m_s": 0.1, "v_m_s": -0.2}}
        u, v = shoal.current(shoal.scenario("construction_square", sets), 0.0, [[0, 9]], [[0, 9]])
        self.assertEqual((u.tolist(), v.tolist()), ([[0.1, 0.1]], [[-0.2, -0.2]]))
        u, _ = shoal.current("redsea_square", 0.0, [0.0, 1e6], [0.0, 0.0])
        self.assertTrue(math.isfinite(u[0]) and math.isnan(u[1]))

    def test_forces_of_a_potential(self):
        planner = shoal.Planner(self.plan, "virtual_potential", "anna",
                                waypoint=(300, 0),
                                obstacles=[{"shape.kind": "circle", "shape.circle":
                                            {"x_m": 900, "y_m": 900, "radius_m": 10}}])
        own = shoal.OwnState([0, 0], velocity=[1, 0], speed_m_s=1.0)
        planner.plan(1.0, own)
        self.assertGreater(planner.force[0], 0)
        # Ahead, and faster within the envelope: 0.05 m/s2 for 0.25 s.
        command = planner.command(own)
        self.assertTrue(command.thrust)
        self.assertTrue(1.0 < command.speed_m_s <= 1.0 + 0.05 * planner.command_period_s)
        self.assertAlmostEqual(command.acceleration_m_s2, (command.speed_m_s - 1) / 0.25)
        self.assertFalse(command.outside_envelope)
        with self.assertRaisesRegex(shoal.InputError, "give an OwnState"):
            planner.command([0, 0])
        # The same world turned by a quarter has the same force, turned by a quarter.
        turned = shoal.Planner(self.plan, "virtual_potential", "anna",
                               waypoint=(0, 300),
                               obstacles=[{"shape.kind": "circle", "shape.circle":
                                           {"x_m": -900, "y_m": 900, "radius_m": 10}}])
        turned.plan(1.0, shoal.OwnState([0, 0], velocity=[0, 1], heading_rad=math.pi / 2, speed_m_s=1.0))
        east, north = planner.force
        numpy.testing.assert_allclose(turned.force, [-north, east], atol=1e-12)

    def test_from_pings_to_headings_and_drift(self):
        position = numpy.array([970, 610])
        planner = shoal.Planner(self.plan, "rigid_registration", "anna",
                                guidance_options={"drifting_radius_m": 25})
        self.assertEqual(planner.command_period_s, 0.25)
        self.assertFalse(planner.command(position).thrust)
        planner.receive(self.ping(1, (1000, 600), position), position)
        planner.receive(self.ping(2, (900, 500), position), position)
        east, north = planner.plan(2.0, position)
        command = planner.command(position)
        self.assertEqual((command.thrust, command.speed_m_s), (math.hypot(east, north) > 25, 1.0))
        self.assertAlmostEqual(command.heading_rad, math.atan2(north, east))
        self.assertFalse(planner.command(position + [east, north]).thrust)
        self.assertFalse(planner.command(position + [east + 20, north]).thrust)  # latched
        self.assertTrue(planner.command(position + [east + 26, north]).thrust)

    def test_a_copy_goes_on_with_the_same_bits_and_by_itself(self):
        position = numpy.array([970, 610])
        planner = shoal.Planner(self.plan, "assignment_registration", "anna")
        planner.receive(self.ping(1, (1000, 600), position), position)
        planner.plan(1.0, position)
        for duplicate in (copy.copy, copy.deepcopy):
            other = duplicate(planner)
            for one in (planner, other):
                one.receive(self.ping(2, (900, 500), position), position)
            self.assertEqual(planner.plan(2.0, position).tolist(), other.plan(2.0, position).tolist())
            before = planner.target(position).tolist()
            other.plan(200.0, position + [9, 9])  # all that it heard is too old by then
            self.assertEqual(planner.target(position).tolist(), before)
            self.assertNotEqual(other.reason, planner.reason)

    def test_a_guidance_that_does_not_fit_is_refused(self):
        with self.assertRaisesRegex(shoal.InputError, "gives places, and the guidance takes forces"):
            shoal.Planner(self.plan, "rigid_registration", "anna", guidance="conditioned_force")
        with self.assertRaisesRegex(shoal.InputError, "leads vehicles to a waypoint"):
            shoal.Planner(self.plan, "virtual_potential", "anna")

    def test_what_is_wrong_is_said(self):
        with self.assertRaisesRegex(shoal.InputError, "anna, bela and cyra"):
            shoal.Planner(self.plan, "rigid_registration", "dora")
        with self.assertRaisesRegex(shoal.InputError, "ownship_weigt.*ownship_weight"):
            shoal.Planner(self.plan, "rigid_registration", "anna", {"ownship_weigt": 1})
        planner = shoal.Planner(self.plan, "rigid_registration", "anna")
        with self.assertRaises(shoal.InputError):
            planner.receive(self.ping(9, (1, 1)), [0, 0])
        for position in ([math.nan, 0], [0, math.inf]):
            with self.assertRaisesRegex(shoal.InputError, "finite"):
                planner.target(position)
            with self.assertRaisesRegex(shoal.InputError, "finite"):
                planner.command(position)
            with self.assertRaisesRegex(shoal.InputError, "finite"):
                planner.plan(1.0, position)
        with self.assertRaisesRegex(shoal.InputError, "two columns"):
            shoal.Plan([1, 2, 3])

    def test_a_plan_is_padded_as_far_as_the_quality_of_a_run(self):
        sizes = {"rows": 1, "columns": 1}
        self.assertEqual(len(shoal.Plan.padded("square", **sizes)), 9)
        self.assertEqual(len(shoal.Plan.padded("square", layers=100, **sizes)), 201**2)
        for kind in ("square", "letters"):
            for layers in (-1, 101, 10**6, 2**70):
                with self.assertRaisesRegex(shoal.InputError, "^layers is .*; it takes from 0 to 100"):
                    shoal.Plan.padded(kind, layers=layers)
        for layers in (1.5, "2", True, None):
            with self.assertRaisesRegex(shoal.InputError, "^layers is .*; it takes an integer"):
                shoal.Plan.padded("square", layers=layers)
        with self.assertRaisesRegex(shoal.InputError, "it takes from 0 to 100"):
            shoal.scenario("redsea_square", {"quality.layers": 101})


class Problems(Desk):
    def test_every_solver_that_takes_it_finds_the_minimum(self):
        problem = shoal.Problem(lambda x: (x[0] - 1)**2 + 10 * (x[1] + 2)**2, [0, 0],
                                lower=[-5, -5], upper=[5, 5])
        solved = 0
        for solver in shoal.catalogue("solver"):
            try:
                solution = shoal.solve(problem, solver)
            except shoal.InputError as error:
                self.assertIn(solver, str(error))
                continue
            self.assertTrue(solution.usable, solver)
            # Ten of the steps at which solvers stop.
            numpy.testing.assert_allclose(solution.x, [1, -2], atol=1e-3, err_msg=solver)
            solved += 1
        self.assertGreater(solved, 15)

    def test_derivatives_are_used_where_given(self):
        asked = []
        problem = shoal.Problem(lambda x: x[0]**4, [3.0], gradient=lambda x: [4 * x[0]**3],
                                hessian=lambda x: asked.append(1) or [[12 * x[0]**2]])
        cost, gradient, hessian = problem.evaluate([2.0])
        self.assertEqual((cost, gradient[0], hessian[0, 0]), (16, 32, 48))
        self.assertTrue(asked)
        differences = shoal.Problem(lambda x: x[0]**4, [3.0]).evaluate([2.0])
        numpy.testing.assert_allclose([differences[1][0], differences[2][0, 0]], [32, 48], rtol=1e-4)

    def test_the_problems_of_a_behaviour(self):
        posed = shoal.posed("attraction_repulsion", {"separation_m": 300}, [[200, 0], [0, 310]],
                            shoal.Plan([[0, 0], [1, 0]]))
        self.assertEqual(len(posed), 1)
        newton = shoal.solve(posed[0])
        other = shoal.solve(posed[0], "nlopt.lbfgs")
        self.assertEqual(newton.status, "converged")
        numpy.testing.assert_allclose(other.x, newton.x, atol=1e-3)

    def test_a_cost_returns_one_real_number(self):
        start = numpy.array([0.5, 0.5])
        for wrong, says in ((lambda x: None, "the cost returned None; it has to return one real number"),
                            (lambda x: x, r"returned an array of shape \(2,\)"),
                            (lambda x: "1", "returned text"), (lambda x: 1j, "a complex number"),
                            (lambda x: numpy.complex128(1), "a complex number"),
                            (lambda x: {}, "returned a dict"),
                            (lambda x: 10**400, "an integer too large for a real number"),
                            (lambda x: numpy.ma.masked, "returned a masked array")):
            with self.assertRaisesRegex(shoal.InputError, says):
                shoal.solve(shoal.Problem(wrong, start))
        for right in (lambda x: int(x[0] > 9), lambda x: numpy.float32(3), lambda x: numpy.array(2.0)):
            shoal.solve(shoal.Problem(right, start))
        for part in ("gradient", "hessian"):
            for wrong, says in ((lambda x: None, f"the {part} returned None".replace("hess", "Hess")),
                                (lambda x: numpy.ones(2) * 1j, "complex numbers")):
                with self.assertRaisesRegex(shoal.InputError, says):
                    shoal.solve(shoal.Problem(lambda x: x @ x, start, **{part: wrong}))

    def test_what_a_behaviour_solves_can_be_kept_and_solved(self):
        plan = shoal.Plan(numpy.array([[0, 0], [30, 0], [0, 30]], float))
        near = numpy.array([[30.0, 2], [1, 30]])
        with self.assertRaisesRegex(shoal.InputError, "leads to a waypoint"):
            shoal.posed("virtual_potential_step", {}, near, plan)
        problems = shoal.posed("virtual_potential_step", {}, near, plan, waypoint=(300, 0))
        before = problems[0].evaluate([1.0, 2.0])[0]
        del near
        self.assertEqual(problems[0].evaluate([1.0, 2.0])[0], before)
        self.assertEqual(shoal.solve(problems[0], "newton").status, "converged")

    def test_a_match_that_cannot_be_is_refused_in_words(self):
        places = numpy.eye(2) * 100
        for step in (0, 1e-7, -10, 181, math.nan):
            with self.assertRaisesRegex(shoal.InputError, "delta_theta_deg is .*; it takes from"):
                shoal.match(places, places, options={"delta_theta_deg": step})
        with self.assertRaisesRegex(shoal.InputError, "3 points for 2 slots"):
            shoal.match(numpy.ones((3, 2)), places)
        with self.assertRaisesRegex(shoal.InputError, "0 points"):
            shoal.match(numpy.ones((0, 2)), places)

    def test_positions_are_real_finite_and_of_this_world(self):
        good = numpy.array([[0, 0], [100, 0], [0, 50]], float)
        plan = shoal.Plan(good)
        takes_points = {"points": lambda p: shoal.match(p, good), "slots": lambda p: shoal.match(good, p),
                        "from_points": lambda p: shoal.register(p, good),
                        "to_points": lambda p: shoal.register(good, p),
                        "positions": lambda p: shoal.formation_quality(p, plan)}
        wrongs = ((good + 1j, "is an array of complex numbers; it takes an array of real numbers"),
                  (good * math.nan, "row 0 is not finite"), (good + [[0, 0], [math.inf, 0], [0, 0]], "row 1 is not"),
                  (good + 1e308, r"row 0 is too large; give at most 1e\+09 m"),
                  (numpy.ma.masked_equal(good, 50), "is a masked array"), (None, "is None"),
                  ("here", "is an array of <U4"))
        for name, call in takes_points.items():
            call(good.tolist())
            for wrong, says in wrongs:
                with self.subTest(name=name, says=says):
                    with self.assertRaisesRegex(shoal.InputError, f"^{name}:? {says}"):
                        call(wrong)

    def test_arguments_of_another_kind_are_refused_by_name(self):
        places = numpy.eye(2) * 100
        problem = shoal.Problem(lambda x: x @ x, [1.0, 2.0])
        for name, call in (("options", lambda: shoal.match(places, places, options=5)),
                           ("ownship_weight", lambda: shoal.match(places, places, "much")),
                           ("weights", lambda: shoal.register(places, places, [1j, 1])),
                           ("loss", lambda: shoal.register(places, places, loss=None)),
                           ("solver", lambda: shoal.solve(problem, 5)),
                           ("start", lambda: shoal.Problem(lambda x: 0.0, [1j])),
                           ("x", lambda: problem.evaluate(None)),
                           ("behaviour", lambda: shoal.posed(5, {}, places, shoal.Plan(places))),
                           ("time_s", lambda: shoal.current("construction_square", 1j, 0.0, 0.0)),
                           ("family", lambda: shoal.options(5, "newton")),
                           ("version", lambda: shoal.potential(thesis, version=1)),
                           ("r", lambda: shoal.potential("thesis").derivatives(1j, 300.0))):
            with self.subTest(name=name), self.assertRaisesRegex(shoal.InputError, f"^{name} is .*; it takes"):
                call()

    def test_a_match_of_too_many_is_refused(self):
        places = numpy.random.default_rng(1).uniform(0, 1000, (3000, 2))
        with self.assertRaisesRegex(shoal.InputError, r"at most 1e\+09 points x rotations x slots.*3.24e\+09"):
            shoal.match(places, places, options={"delta_theta_deg": 1})

    def test_a_match_is_interrupted(self):
        self.write("long.py", """
import numpy
import shoal
places = numpy.random.default_rng(1).uniform(0, 1000, (2, 4000, 2))
print("on its way", flush=True)
shoal.match(places[0, :2000], places[1])  # some minutes
""")
        with subprocess.Popen([sys.executable, "long.py"], cwd=self.desk, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
            try:
                self.assertEqual(running.stdout.readline(), "on its way\n")
                running.send_signal(signal.SIGINT)
                _, complaint = running.communicate(timeout=120)
            finally:
                running.kill()
        self.assertIn("KeyboardInterrupt", complaint)

    def test_registration_and_matching(self):
        points = numpy.array([[0, 0], [100, 0], [0, 50], [30, 30]], float)
        turn = numpy.array([[0, -1], [1, 0]])
        found = shoal.register(points, points @ turn.T + [7, -3])
        self.assertAlmostEqual(found["angle_rad"], math.pi / 2)
        numpy.testing.assert_allclose(found["translation"], [7, -3], atol=1e-9)
        moved = points @ turn.T + [7, -3]
        moved[0] += 400
        robust = shoal.register(points, moved, solver="newton", loss="tukey",
                                weights=[1, 1, 1, 1])
        self.assertTrue(robust["usable"])
        match = shoal.match(points[[2, 0, 3, 1]] @ turn.T, points)
        self.assertEqual(match["slots"], [2, 0, 3, 1])

    def test_quality_is_that_of_a_run(self):
        sets = {"trial.duration_s": 1200, "quality.layers": 0}
        dataset, measures = shoal.run("redsea_square", sets)
        options = shoal.scenario("redsea_square", sets)["plan"]["square"]
        last = dataset.isel(time=-1)
        positions = numpy.column_stack([last.x, last.y])
        quality = shoal.formation_quality(positions, shoal.Plan.of("square", **options))
        self.assertAlmostEqual(quality, measures["quality_final_m"], places=3)


class Studies(Desk):
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
        with subprocess.Popen([sys.executable, "long.py"], cwd=self.desk, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
            try:
                self.assertEqual(running.stdout.readline(), "on its way\n")
                running.send_signal(signal.SIGINT)
                _, complaint = running.communicate(timeout=120)  # the trials would take hours
            finally:
                running.kill()
        self.assertIn("KeyboardInterrupt", complaint)


class Catalogue(Desk):
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
            allowed.write_text(r"shoal\._shoal\.\w+" "\n" r"shoal\._shoal\.(Command|Solution|Table)\.__init__"
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
