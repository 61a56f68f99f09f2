"""Problems, solvers, registration and matching from Python.

    PYTHONPATH=build/ci/python python3 python_problems_test.py SHOAL
"""

import math

import desk
import numpy
import shoal
from python_desk import PythonDesk, thesis


class Problems(PythonDesk):
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
                           ("plan", lambda: shoal.posed("pairwise_referencing", {}, places, places)),
                           *((name, lambda name=name, value=value: shoal.posed(
                               "pairwise_referencing", {}, places, shoal.Plan(places), **{name: value}))
                             for name, value in (("own_slot", 2), ("own_slot", "0"), ("own_slot", 0.5),
                                                 ("slots", 5), ("slots", "01"), ("waypoint", "north"))),
                           (r"slots\[1\]", lambda: shoal.posed("pairwise_referencing", {}, places,
                                                               shoal.Plan(places), slots=[0, 2])),
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
        self.assert_interrupted("long.py")

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


if __name__ == "__main__":
    desk.main()
