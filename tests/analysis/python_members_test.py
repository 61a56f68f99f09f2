"""Classes of Python as behaviours, selections, guidance laws, solvers and measures.

    PYTHONPATH=build/ci/python python3 python_members_test.py SHOAL
"""

import copy
import math
import pathlib
import re
import subprocess
import sys
import threading
from typing import Annotated

import desk
import numpy
import shoal
import shoal.testing
from python_desk import PythonDesk, Until

SHORT = {"trial.duration_s": 300}


@shoal.behaviour
class RigidByHand:
    """What rigid_registration does, by shoal.register()."""

    needs_ids = True

    def target(self, seen):
        known = seen.slots >= 0
        if not known.any():
            return None
        slots = [seen.own_slot, *seen.slots[known]]
        motion = shoal.register(seen.plan[slots], numpy.vstack([numpy.zeros(2), seen.positions[known]]))
        if not motion["usable"]:
            return None
        angle = motion["angle_rad"]
        turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        return turn @ seen.plan[seen.own_slot] + motion["translation"]


@shoal.behaviour
class Mean:
    """Goes a share of the way to the middle of its neighbours."""

    def __init__(self, share: Annotated[float, "", "of the way"] = 0.5):
        self.share = share

    def target(self, seen):
        if len(seen.positions) == 0:
            return None
        return self.share * numpy.add.reduce(seen.positions) / len(seen.positions)


@shoal.behaviour
class MeanTogether:
    """The same for all vehicles at once."""

    most = 0

    def __init__(self, share: float = 0.5):
        self.share = share

    def targets(self, seen):
        MeanTogether.most = max(MeanTogether.most, len(seen.positions))
        sums = numpy.add.reduce(numpy.where(seen.present[:, :, None], seen.positions, 0.0), axis=1)
        counts = seen.present.sum(axis=1)[:, None]
        with numpy.errstate(invalid="ignore"):
            return numpy.where(counts > 0, self.share * sums / counts, numpy.nan)


@shoal.behaviour
class Growing:
    """A share of the way to the middle of its neighbours that grows with each target."""

    def new_memory(self):
        return {"targets": 0}

    def target(self, seen, memory):
        if len(seen.positions) == 0:
            return None
        memory["targets"] += 1
        return memory["targets"] / 100 * numpy.add.reduce(seen.positions) / len(seen.positions)


@shoal.behaviour
class GrowingTogether:
    def new_memory(self):
        return {"targets": 0}

    def targets(self, seen, memories):
        sums = numpy.add.reduce(numpy.where(seen.present[:, :, None], seen.positions, 0.0), axis=1)
        counts = seen.present.sum(axis=1)
        targets = numpy.full(sums.shape, numpy.nan)
        for i in numpy.flatnonzero(counts):
            memories[i]["targets"] += 1
            targets[i] = memories[i]["targets"] / 100 * sums[i] / counts[i]
        return targets


@shoal.measure
class Spread:
    values = {"spread_by_hand_m": ("m", "mean distance from the middle at the end"),
              "spread_undefined_m": ("m", "never there")}
    series = {"spread_over_time": ("m", "the same against time")}

    def begin(self, world):
        self.times, self.numbers = [], []

    def observe(self, world):
        self.times.append(world.time_s)
        self.numbers.append(self.now(world))

    def finish(self, world):
        return {"spread_by_hand_m": self.now(world), "spread_over_time": (self.times, self.numbers)}

    @staticmethod
    def now(world):
        middle = world.positions.mean(axis=0)
        return numpy.linalg.norm(world.positions - middle, axis=1).mean()


class Behaviours(PythonDesk):
    def test_the_same_registration_gives_the_same_tracks(self):
        by_class = shoal.run("construction_square", {**SHORT, "behaviour.kind": "rigid_by_hand"}, seed=3)
        built_in = shoal.run("construction_square", {**SHORT, "behaviour.kind": "rigid_registration"}, seed=3)
        for name in ("x", "y"):
            numpy.testing.assert_allclose(by_class.dataset[name], built_in.dataset[name], atol=1e-6)

    def test_all_at_once_or_one_by_one_gives_the_same_bits(self):
        kinds = ("mean", "mean_together")
        runs = [shoal.run("construction_square", {**SHORT, "behaviour.kind": kind}) for kind in kinds]
        self.assertEqual(runs[0].measures, runs[1].measures)
        self.assertGreater(MeanTogether.most, 2)
        threads = shoal.run("construction_square", {**SHORT, "behaviour.kind": "mean_together"}, threads=3)
        self.assertEqual(threads.measures, runs[0].measures)

    def test_what_the_constructor_takes_are_options(self):
        options = shoal.options("behaviour", "mean").set_index("key")
        self.assertEqual(options.loc["behaviour.mean.share", ["default", "meaning"]].tolist(), [0.5, "of the way"])
        self.assertEqual(shoal.catalogue("behaviour")["mean"],
                         "Goes a share of the way to the middle of its neighbours.")
        near, far = (shoal.run("construction_square", {**SHORT, "behaviour.kind": "mean",
                                                       "behaviour.mean.share": share}).measures
                     for share in (1, 0.01))
        self.assertLess(near["spread_by_hand_m"], far["spread_by_hand_m"])
        with self.assertRaisesRegex(shoal.InputError, r"behaviour.mean.share is a string .*; it takes a number"):
            shoal.scenario("construction_square", {"behaviour.mean.share": "much"})
        with self.assertRaisesRegex(shoal.InputError, 'behaviour.mean has no option "part"'):
            shoal.scenario("construction_square", {"behaviour.mean.part": 1})

    def test_options_are_factors_of_a_study(self):
        study = {"scenario": "construction_square", "replications": 2, "set": SHORT,
                 "factor": [{"key": "behaviour.kind", "values": ["mean", "mean_together"]},
                            {"key": "behaviour.mean.share", "values": [0.2, 0.6]}],
                 "table": [{"name": "spread", "rows": ["kind"], "columns": ["share"],
                            "measures": ["spread_by_hand_m"]}]}
        one, two = (shoal.sweep(study, self.desk / f"out-{jobs}", jobs=jobs) for jobs in (1, 2))
        self.assertEqual(one.to_csv(), two.to_csv())
        self.assertEqual(one.groupby(["kind", "share"]).spread_by_hand_m.nunique().tolist(), [2, 2, 2, 2])
        self.assertEqual(len(one), 8)

    def test_what_a_behaviour_knows(self):
        seen = []

        @shoal.behaviour
        class Curious:
            needs_waypoint = True
            needs_clock = True

            def __init__(self):
                pass

            def target(self, given):
                seen.append(given)
                return 0.1 * (given.waypoint - given.own.position)

        shoal.run("construction_square",
                  {"trial.duration_s": 60, "behaviour.kind": "curious", "planner.update": "tick", "waypoint": {"x_m": 500, "y_m": 100},
                   "obstacle": [{"shape": {"kind": "circle", "circle": {"x_m": 2000, "y_m": 0, "radius_m": 50}}}]})
        last = seen[-1]
        n = len(last.positions)
        self.assertGreater(n, 0)
        self.assertEqual([a.shape for a in (last.positions, last.velocities, last.ages_s, last.slots, last.plan)],
                         [(n, 2), (n, 2), (n,), (n,), (20, 2)])
        self.assertEqual(last.waypoint.tolist(), [500, 100])
        distance, normal = last.nearest_obstacle([1900, 0])
        self.assertAlmostEqual(distance, 50)
        numpy.testing.assert_allclose(normal, [-1, 0], atol=1e-12)
        self.assertNotIn(last.own_slot, last.slots)

    def test_planners_take_them_too(self):
        plan = shoal.Plan([[0, 0], [100, 0]])
        planner = shoal.Planner(plan, "mean", "1", {"share": 1.0})
        planner.receive(shoal.Ping(time_s=0, range_m=80, bearing_rad=0), [0, 0])
        numpy.testing.assert_allclose(planner.plan(1, [0, 0]), [80, 0], atol=1e-9)

    def test_each_vehicle_has_a_memory_of_its_own(self):
        runs = [shoal.run("construction_square", {**SHORT, "behaviour.kind": kind}, threads=threads).measures
                for kind, threads in (("growing", 1), ("growing_together", 1), ("growing_together", 3))]
        self.assertEqual(runs[0], runs[1])
        self.assertEqual(runs[0], runs[2])

    def test_the_memory_of_a_planner_goes_with_its_copy(self):
        planner = shoal.Planner(shoal.Plan([[0, 0], [100, 0]]), "growing", "1")
        planner.receive(shoal.Ping(time_s=0, range_m=80, bearing_rad=0), [0, 0])
        self.assertAlmostEqual(planner.plan(1, [0, 0])[0], 0.8)
        twin = copy.copy(planner)
        for each in (planner, twin):
            self.assertAlmostEqual(each.plan(2, [0, 0])[0], 1.6)
        self.assertAlmostEqual(planner.plan(3, [0, 0])[0], 2.4)
        self.assertAlmostEqual(twin.plan(3, [0, 0])[0], 2.4)

    def test_what_target_returns_is_checked(self):
        wrong = {"one place": [1, 2, 3], "real": "north", "finite": (math.nan, 0.0), "None": None}

        @shoal.behaviour(version="1")
        class Answers:
            answer = None

            def target(self, seen):
                return Answers.answer

        for words, answer in wrong.items():
            Answers.answer = answer
            with self.subTest(words):
                if answer is None:
                    shoal.run("construction_square", {**SHORT, "behaviour.kind": "answers"})
                    continue
                with self.assertRaisesRegex(shoal.InputError, words):
                    shoal.run("construction_square", {**SHORT, "behaviour.kind": "answers"})

    def test_what_a_method_raises_comes_out_unchanged(self):
        @shoal.behaviour
        class Failing:
            def __init__(self, message: str = "no way"):
                self.message = message

            def target(self, seen):
                raise KeyError(self.message)

        with self.assertRaisesRegex(KeyError, "no way"):
            shoal.run("construction_square", {**SHORT, "behaviour.kind": "failing"})
        study = {"scenario": "construction_square", "set": {**SHORT, "behaviour.kind": "failing"},
                 "factor": [{"key": "ping.period_s", "values": [5, 10]}]}
        trials = shoal.sweep(study, self.desk / "out", jobs=2)
        self.assertEqual(set(trials.status), {"failed"})
        self.assertTrue(all("no way" in reason for reason in trials.reason))

    def test_a_hint_says_how_to_be_faster(self):
        with self.assertWarnsRegex(RuntimeWarning, "targets\\(\\)"), self.assertRaises(StopIteration):
            shoal.run("redsea_square_as_run", {"behaviour.kind": "mean", "trial.duration_s": 1e5},
                      progress=Until(6.5))


class Versions(PythonDesk):
    def test_another_text_of_a_class_is_another_version(self):
        def version(text):
            names = {}
            exec(compile(text, "cell", "exec"), {"shoal": shoal}, names)
            return shoal.scenario("construction_square", {"behaviour.kind": "cell"})

        text = ("@shoal.behaviour\nclass Cell:\n"
                "    def target(self, seen):\n        return seen.positions[0] * {}\n")
        first, same, other = (version(text.format(factor)) for factor in (0.5, 0.5, 0.6))
        self.assertEqual(first, same)
        self.assertNotEqual(first["behaviour"]["cell"]["version"], other["behaviour"]["cell"]["version"])
        with self.assertRaisesRegex(shoal.InputError, "this was written with version .* of the class cell"):
            shoal.run(first)

    def test_stored_trials_are_those_of_a_version(self):
        study = {"scenario": "construction_square", "replications": 1,
                 "set": {**SHORT, "behaviour.kind": "changing"}}
        for factor in (0.5, 0.6):
            exec("@shoal.behaviour\nclass Changing:\n    def target(self, seen):\n"
                 f"        return seen.positions[0] * {factor}\n", {"shoal": shoal})
            if factor == 0.5:
                shoal.sweep(study, self.desk / "out")
        with self.assertRaisesRegex(shoal.InputError, "rerun"):
            shoal.sweep(study, self.desk / "out")
        self.assertEqual(len(shoal.sweep(study, self.desk / "out", rerun_changed=True)), 1)

    def test_names_that_are_taken_or_cannot_be_written(self):
        with self.assertRaisesRegex(shoal.InputError, 'there is a behaviour "rigid_registration" already'):
            shoal.behaviour(type("RigidRegistration", (), {"target": lambda self, seen: None}))
        with self.assertRaisesRegex(shoal.InputError, 'there is a solver "nlopt" already'):
            shoal.solver(type("Nlopt", (), {"solve": lambda self, problem: problem.start}))
        with self.assertRaisesRegex(shoal.InputError, "cannot be written in a scenario"):
            shoal.behaviour(type("Ähnlich", (), {"target": lambda self, seen: None}))
        with self.assertRaisesRegex(shoal.InputError, 'yields "energy_mean_wh" already'):
            shoal.measure(type("Energy2", (), {"values": {"energy_mean_wh": ("Wh", "x")},
                                               "finish": lambda self, world: {}}))

    def test_a_class_that_does_not_fit_is_refused(self):
        cases = [(shoal.behaviour, {}, "no method target"),
                 (shoal.selection, {}, "no method select"),
                 (shoal.guidance, {"command": lambda self, to, own: None}, "has no period_s"),
                 (shoal.guidance, {"command": lambda self, to, own: None, "period_s": 0,
                                   "highest_speed_m_s": 1}, "above 0"),
                 (shoal.solver, {}, "no method solve"),
                 (shoal.behaviour, {"target": lambda self, seen: None, "needs_ids": 1}, "True or False")]
        where = {shoal.behaviour: "behaviour", shoal.guidance: "guidance"}
        for k, (register, members, complaint) in enumerate(cases):
            with self.subTest(complaint):
                cls = register(type(f"Unfit{k}", (), members))
                kind = f"unfit{k}"
                with self.assertRaisesRegex(shoal.InputError, complaint):
                    if register is shoal.selection:
                        shoal.run("construction_hexagonal", {
                            **SHORT, "behaviour.kind": "attraction_repulsion",
                            "behaviour.attraction_repulsion.selection.kind": kind})
                    elif register is shoal.solver:
                        shoal.solve(shoal.Problem(lambda x: x[0]**2, [1.0]), kind)
                    else:
                        shoal.run("construction_square", {**SHORT, f"{where[register]}.kind": kind})
                self.assertIsInstance(cls, type)
        for members, complaint in (({}, "no method finish"), ({"finish": lambda self, world: {}}, "yields nothing"),
                                   ({"finish": lambda self, world: {}, "values": {"a_m": "m"}}, "takes a tuple")):
            with self.assertRaisesRegex(shoal.InputError, complaint):
                shoal.measure(type("Unfit", (), members))
        with self.assertRaisesRegex(shoal.InputError, "has no default"):
            @shoal.behaviour
            class NoDefault:
                def __init__(self, share):
                    self.share = share

                def target(self, seen):
                    return None
        with self.assertRaisesRegex(shoal.InputError, "is a class"):
            shoal.behaviour(lambda seen: None)

    def test_no_class_becomes_a_member_while_a_run_is_under_way(self):
        complaints = []

        def late(now):
            try:
                shoal.behaviour(type("Late", (), {"target": lambda self, seen: None}))
            except shoal.InputError as error:
                complaints.append(str(error))
            raise StopIteration

        with self.assertRaises(StopIteration):
            shoal.run("redsea_square", {"trial.duration_s": 20000}, progress=late)
        self.assertEqual(complaints, ["a run or a sweep is under way; make late known before it"])


class Readme(PythonDesk):
    def test_its_example_runs_as_it_stands(self):
        readme = pathlib.Path(__file__).parents[2].joinpath("README.md").read_text(encoding="utf-8")
        blocks = [block for block in re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
                  if "@shoal.behaviour" in block]
        self.assertEqual(len(blocks), 1)
        self.write("example.py", "import numpy\nimport shoal\nimport shoal.testing\n" + blocks[0].replace(
            '"replications": 5, "set": {', '"replications": 1, "set": {"trial.duration_s": 120, '))
        done = subprocess.run([sys.executable, "-W", "ignore", "example.py"], cwd=self.desk, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"share\n0\.2 +\d+\.\d+\n0\.5 ")


class OtherFamilies(PythonDesk):
    def test_a_selection(self):
        @shoal.selection
        class NearestOfMine:
            def __init__(self, count: int = 2):
                self.count = count

            def select(self, positions):
                distances = numpy.hypot(positions[:, 0], positions[:, 1])
                return numpy.argsort(distances, kind="stable")[:self.count]

        key = "behaviour.attraction_repulsion.selection"
        mine, built_in = (
            shoal.run("construction_hexagonal",
                      {**SHORT, "behaviour.kind": "attraction_repulsion", f"{key}.kind": kind, **more}).measures
            for kind, more in (("nearest_of_mine", {f"{key}.nearest_of_mine.count": 3}),
                               ("k_nearest", {f"{key}.k_nearest.k": 3})))
        self.assertEqual(mine, built_in)

    def test_selections_are_checked(self):
        for answer, complaint in (([], "at least one"), ([0, 0], "no index twice"), ([99], "indices from 0"),
                                  ([0.5], "indices from 0")):
            @shoal.selection(version=repr(answer))
            class Picky:
                given = answer

                def select(self, positions):
                    return numpy.array(Picky.given, dtype=float)

            with self.assertRaisesRegex(shoal.InputError, complaint):
                shoal.run("construction_hexagonal", {
                    **SHORT, "behaviour.kind": "attraction_repulsion",
                    "behaviour.attraction_repulsion.selection.kind": "picky"})

    def test_a_guidance_law(self):
        @shoal.guidance
        class Straight:
            period_s = 1.0

            def __init__(self, radius_m: float = 20.0, speed_m_s: float = 0.5):
                self.radius_m, self.highest_speed_m_s = radius_m, speed_m_s

            def command(self, to_target, own):
                if math.hypot(*to_target) < self.radius_m:
                    return None
                return math.atan2(to_target[1], to_target[0]), self.highest_speed_m_s

        tight, loose = (
            shoal.run("construction_square", {"trial.duration_s": 3000, "guidance.kind": "straight",
                                              "guidance.straight.radius_m": radius}).measures
            for radius in (5, 60))
        self.assertLess(tight["quality_settled_m"], loose["quality_settled_m"])

        @shoal.guidance
        class TooFast(Straight):
            def command(self, to_target, own):
                return 0.0, 2.0

        with self.assertRaisesRegex(shoal.InputError, "a speed from 0 to its highest_speed_m_s, 0.5"):
            shoal.run("construction_square", {**SHORT, "guidance.kind": "too_fast"})

    def test_a_solver(self):
        @shoal.solver
        class Steps:
            """Newton's steps, by hand."""

            takes_bounds = False

            def solve(self, problem):
                x = problem.start
                for _ in range(50):
                    _, gradient, hessian = problem.derivatives(x)
                    step = numpy.linalg.solve(hessian, -gradient)
                    x = x + step
                    if numpy.abs(step).max() < 1e-10:
                        return x
                return x

        bowl = shoal.Problem(lambda x: (x[0] - 3)**2 + 2 * (x[1] + 1)**2, [0.0, 0.0],
                             gradient=lambda x: [2 * (x[0] - 3), 4 * (x[1] + 1)],
                             hessian=lambda x: [[2, 0], [0, 4]])
        solution = shoal.solve(bowl, "steps")
        self.assertEqual(solution.status, "converged")
        numpy.testing.assert_allclose(solution.x, [3, -1], atol=1e-9)
        self.assertLess(solution.evaluations, 6)
        few = shoal.solve(bowl, "steps", {"max_evaluations": 1})
        self.assertEqual(few.status, "budget_spent" if few.status == "budget_spent" else few.status)
        self.assertEqual(few.evaluations, 1)
        with self.assertRaisesRegex(shoal.InputError, "steps takes no bounds"):
            shoal.solve(shoal.Problem(lambda x: x[0]**2, [1.0], lower=[0.5], upper=[2.0]), "steps")
        key = "behaviour.attraction_repulsion.solver"
        plain = {**SHORT, "behaviour.kind": "attraction_repulsion"}
        mine = shoal.run("construction_hexagonal", {**plain, f"{key}.kind": "steps"})
        newton = shoal.run("construction_hexagonal", plain)
        self.assertEqual(len(mine.dataset.vehicle), len(newton.dataset.vehicle))

    def test_a_solver_that_lies_is_found_out(self):
        @shoal.solver
        class Lazy:
            def solve(self, problem):
                return problem.start

        @shoal.solver
        class Short:
            def solve(self, problem):
                return problem.start[:1]

        bowl = shoal.Problem(lambda x: (x[0] - 3)**2 + x[1]**2, [0.0, 0.0])
        self.assertNotEqual(shoal.solve(bowl, "lazy").status, "converged")
        with self.assertRaisesRegex(shoal.InputError, "a point of 2 unknowns"):
            shoal.solve(bowl, "short")

    def test_a_problem_is_gone_when_it_is_solved(self):
        kept = []

        @shoal.solver
        class Keeping:
            def solve(self, problem):
                kept.append(problem)
                return problem.start

        shoal.solve(shoal.Problem(lambda x: x[0]**2, [1.0]), "keeping")
        with self.assertRaisesRegex(shoal.InputError, "only there while"):
            kept[0].cost([0.0])

    def test_a_cost_that_raises_comes_through_a_solver(self):
        @shoal.solver
        class Asking:
            def solve(self, problem):
                problem.cost(problem.start)
                return problem.start

        with self.assertRaises(ZeroDivisionError):
            shoal.solve(shoal.Problem(lambda x: 1 / 0, [1.0]), "asking")


class Measures(PythonDesk):
    def test_a_measure_is_part_of_every_trial(self):
        run = shoal.run("construction_square", SHORT)
        last = run.dataset.isel(time=-1)
        middle = numpy.array([last.x.mean(), last.y.mean()])
        spread = numpy.hypot(last.x - middle[0], last.y - middle[1]).mean()
        self.assertAlmostEqual(run.measures["spread_by_hand_m"], float(spread), delta=1e-3)
        self.assertIsNone(run.measures["spread_undefined_m"])
        self.assertIn("spread_over_time", run.dataset)
        self.assertEqual(shoal.measures().loc["spread_by_hand_m", "unit"], "m")
        self.assertIn("spread-", shoal.program())

    def test_what_its_constructor_takes_are_options_under_its_name(self):
        @shoal.measure
        class Scaled:
            values = {"scaled_time_s": ("s", "the duration, scaled")}

            def __init__(self, scale: Annotated[float, "", "factor"] = 1.0):
                self.scale = scale

            def finish(self, world):
                return {"scaled_time_s": self.scale * world.time_s}

        key = "measure.scaled.scale"
        self.assertEqual(shoal.options("measure", "scaled").set_index("key").loc[key, "default"], 1.0)
        run = shoal.run("construction_square", {"trial.duration_s": 10, key: 3})
        self.assertEqual(run.measures["scaled_time_s"], 30.0)
        study = {"scenario": "construction_square", "set": {"trial.duration_s": 10},
                 "factor": [{"key": key, "values": [1, 2]}],
                 "table": [{"name": "t", "rows": ["scale"], "measures": ["scaled_time_s"]}]}
        swept = shoal.sweep(study, self.desk / "out", jobs=2)
        self.assertEqual(swept.set_index("scale").scaled_time_s.to_dict(), {1: 10.0, 2: 20.0})
        with self.assertRaisesRegex(shoal.InputError, 'measure.scaled has no option "size"'):
            shoal.scenario("construction_square", {"measure.scaled.size": 1})

    def test_its_world_ends_with_the_call(self):
        kept = []

        @shoal.measure
        class Clinging:
            values = {"clinging_n": ("1", "nothing")}

            def finish(self, world):
                kept.append(world)
                return {"clinging_n": len(world)}

        shoal.run("construction_square", {"trial.duration_s": 10})
        with self.assertRaisesRegex(shoal.InputError, "only there while"):
            kept[0].positions

    def test_what_finish_returns_is_checked(self):
        @shoal.measure(version="1")
        class Loose:
            values = {"loose_m": ("m", "anything")}
            answer = {}

            def finish(self, world):
                return Loose.answer

        for answer, complaint in ((3, "a dict"), ({"other_m": 1}, 'not "other_m"'),
                                  ({"loose_m": math.inf}, "finite"), ({"loose_m": "far"}, "real number")):
            Loose.answer = answer
            with self.subTest(complaint), self.assertRaisesRegex(shoal.InputError, complaint):
                shoal.run("construction_square", {"trial.duration_s": 10})
        Loose.answer = {}
        self.assertIsNone(shoal.run("construction_square", {"trial.duration_s": 10}).measures["loose_m"])

    def test_trials_in_threads_each_have_their_own(self):
        results = {}

        def run(seed):
            results[seed] = shoal.run("construction_square", SHORT, seed=seed).measures["spread_by_hand_m"]

        threads = [threading.Thread(target=run, args=(seed,)) for seed in (1, 2, 3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed, spread in results.items():
            self.assertEqual(spread, shoal.run("construction_square", SHORT, seed=seed).measures["spread_by_hand_m"])


class Conformance(PythonDesk):
    def test_what_holds_for_all_holds_for_these(self):
        for behaviour in (Mean, MeanTogether, RigidByHand):
            shoal.testing.check_behaviour(behaviour)
        shoal.testing.check_behaviour("assignment_registration", {"matching.sampled.delta_theta_deg": 10},
                                      turn_step_deg=10)

    def test_what_does_not_hold_is_said_with_an_example(self):
        @shoal.behaviour
        class Northward:
            def target(self, seen):
                return None if len(seen.positions) == 0 else (0.0, 10.0)

        with self.assertRaisesRegex(AssertionError, "behaviour northward:\n"
                                                    "the orientation of the frame means nothing; drawn swarm"):
            shoal.testing.check_behaviour(Northward)
        with self.assertRaisesRegex(shoal.InputError, "is no behaviour yet"):
            shoal.testing.check_behaviour(int)


if __name__ == "__main__":
    desk.main()
