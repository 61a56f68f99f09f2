"""Costs written in Python, and planners for a simulator of one's own.

    PYTHONPATH=build/ci/python python3 python_costs_test.py SHOAL
"""

import copy
import math
import subprocess
import sys
import threading

import desk
import numpy
import shoal
from python_desk import PythonDesk, thesis

REPELLED = {"behaviour.kind": "attraction_repulsion", "trial.duration_s": 900}
LAW = "behaviour.attraction_repulsion.potential"


class Potentials(PythonDesk):
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


class Planning(PythonDesk):
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

    def test_arguments_of_another_kind_are_refused_by_name(self):
        planner = shoal.Planner(self.plan, "rigid_registration", "anna")
        tracks = shoal.PingFilter()
        ping, own = self.ping(1, (100, 0)), shoal.OwnState([0, 0])
        made = {"plan": self.plan, "behaviour": "rigid_registration", "vehicle": "anna"}
        heard = {"time_s": 1, "range_m": 9, "bearing_rad": 0}
        calls = [(name, lambda name=name, wrong=wrong: shoal.Planner(**{**made, name: wrong}))
                 for name, wrong in (("plan", [[0, 0]]), ("behaviour", 5), ("vehicle", None), ("options", [1]),
                                     ("ping_filter", 3), ("obstacles", 7), ("waypoint", "here"),
                                     ("guidance", 1), ("guidance_options", None))]
        calls += [(name, lambda name=name, wrong=wrong: shoal.Ping(**{**heard, name: wrong}))
                  for name, wrong in (("time_s", "now"), ("range_m", None), ("bearing_rad", 1j),
                                      ("elevation_rad", [0]), ("slot", 1.5), ("slot", -2), ("state", [0, 0]))]
        calls += [(name, lambda name=name, wrong=wrong: shoal.OwnState(**{"position": [0, 0], name: wrong}))
                  for name, wrong in (("position", [1j, 0]), ("velocity", None), ("heading_rad", "east"),
                                      ("speed_m_s", 1j), ("turn_rate_rad_s", numpy.complex128(1)))]
        calls += [(name, lambda name=name, wrong=wrong: setattr(own, name, wrong))
                  for name, wrong in (("position", 1j), ("velocity", ["a", "b"]), ("speed_m_s", 1j))]
        calls += [("ping", lambda: planner.receive(5, [0, 0])), ("position", lambda: planner.receive(ping, None)),
                  ("time_s", lambda: planner.plan("now", own)), ("own", lambda: planner.plan(1.0, None)),
                  ("position", lambda: planner.plan(1.0, position="here")),
                  ("position", lambda: planner.target(own)), ("own", lambda: planner.command("here")),
                  ("options", lambda: shoal.PingFilter(5)), ("ping", lambda: tracks.receive(own, [0, 0])),
                  ("position", lambda: tracks.receive(ping, [1j, 0])),
                  ("time_s", lambda: tracks.neighbours(None, [0, 0])),
                  ("position", lambda: tracks.neighbours(1.0, own)),
                  ("names", lambda: shoal.Plan([[0, 0]], "anna")), ("kind", lambda: shoal.Plan.of(5)),
                  ("name", lambda: self.plan.index_of(1))]
        for name, call in calls:
            with self.subTest(name=name), self.assertRaisesRegex(shoal.InputError, f"^{name} is .*; it takes"):
                call()
        for call, says in ((lambda: planner.target([1, 2, 3]), "position has 3 numbers; it takes two"),
                           (lambda: shoal.Planner(**made, obstacles=[5]), "an entry of obstacles is 5; it takes a dict"),
                           (lambda: shoal.Plan([[0, 0]], [5]), "an entry of names is 5; it takes text")):
            with self.assertRaisesRegex(shoal.InputError, f"^{says}"):
                call()

    def test_a_state_can_be_changed(self):
        own = shoal.OwnState([0, 0])
        own.position = (1, 2)
        own.position[0] = 5
        own.speed_m_s = numpy.float32(0.5)
        self.assertEqual((own.position.tolist(), own.speed_m_s), ([5, 2], 0.5))

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


if __name__ == "__main__":
    desk.main()
