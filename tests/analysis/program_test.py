"""The `shoal` program as its user meets it.

    python3 program_test.py SHOAL        (the program; needs xarray and netCDF4)
"""

import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import xarray

SHOAL = ""

SMALL = """[trial]
duration_s = 60
[plan]
square = { rows = 2, columns = 2, separation_m = 300 }
"""
FILE_START = SMALL + '[swarm.start]\nkind = "file"\nfile.path = "starts.csv"\n'
FILE_PLAN = '[trial]\nduration_s = 60\n[plan]\nkind = "file"\nfile.path = "plan.csv"\n'
POINTS = SMALL + '[swarm.start]\nkind = "points"\n'
RED_SEA = SMALL + '[current]\nkind = "netcdf"\nnetcdf.file = "library:currents/redsea_like.nc"\n'
OTHER_SEA = SMALL + '[current]\nkind = "netcdf"\nnetcdf.file = "sea.nc"\n'
REPELLED = ('behaviour.kind = "attraction_repulsion"\n' + SMALL +
            "[behaviour.attraction_repulsion]\n")

METRICS = """energy_mean_wh energy_min_wh energy_max_wh energy_propulsion_mean_wh
energy_hotel_mean_wh energy_comms_mean_wh quality_final_m quality_settled_m time_to_quality_20m_s
centroid_path_m centroid_displacement_m efficiency_m_per_wh thrust_time_ratio_mean
thrust_time_ratio_min thrust_time_ratio_max thrust_distance_ratio_mean formation_rotation_deg
min_separation_m fragments lost_vehicles""".split()
BESIDE = ["scenario", "behaviour", "seed", "vehicles", "duration_s", "wall_s",
          "vehicle_seconds_per_wall_s", "metrics"]
BEHAVIOURS = ["assignment_registration", "attraction_repulsion", "pairwise_referencing",
              "rigid_registration"]
RECORDED = {
    "x": "m", "y": "m", "depth": "m", "heading": "degree", "speed": "m s-1", "thrusting": "1",
    "target_x": "m", "target_y": "m", "target_reason": "1", "energy_propulsion": "W h",
    "energy_hotel": "W h", "energy_comms": "W h", "thrust_time": "s", "distance": "m",
    "thrust_distance": "m"}


def starts(second_row):
    return {"starts.csv": "name,x_m,y_m\nNODE_1,0,0\n" + second_row + "\nNODE_3,9,9\nNODE_4,5,0\n"}


# What is wrong, the scenario, the files beside it, and what the complaint must say, in order.
BAD_SCENARIOS = [
    ("an empty file", "", {}, ["s.toml: ", "says nothing", "[plan]"]),
    ("a comment only", "# later\n", {}, ["s.toml: ", "says nothing"]),
    ("no TOML", "[trial]\nduration_s = \n", {}, ["s.toml:2: ", "not TOML"]),
    ("a table twice", SMALL + "[trial]\nseed = 1\n", {}, ["s.toml:5: ", "not TOML", "trial"]),
    ("an open string", '[plan]\nkind = "square\n', {}, ["s.toml:2: ", "not TOML"]),
    ("bytes", b"\x00\x01\xff" * 99, {}, ["s.toml:1: ", "not TOML"]),
    ("no UTF-8", b'[trial]\nstart = "\xff"\n', {}, ["s.toml:2: ", "not TOML"]),
    ("an unknown key", SMALL + "[ping]\nperod_s = 30\n", {},
     ["s.toml:6: ", 'ping has no option "perod_s"', 'did you mean "period_s"?']),
    ("an unknown table", SMALL + "[pin]\n", {}, ["s.toml:5: ", '"pin"', 'did you mean "ping"?']),
    ("a table in a member", SMALL + "[behaviour.rigid_registration.x]\n", {},
     ["s.toml:5: ", 'behaviour.rigid_registration has no option "x"; known are']),
    ("a table of no member", SMALL + "[behaviour.rigid]\n", {},
     ["s.toml:5: ", 'behaviour has no option "rigid"', 'did you mean "rigid_registration"?']),
    ("wrong options of another kind",
     SMALL + "[behaviour.assignment_registration]\ndelta_theta_deg = 0\n", {},
     ["s.toml:6: ", "delta_theta_deg is 0; it takes above 0 and at most 180 deg"]),
    ("text for a number", SMALL + '[ping]\nperiod_s = "30"\n', {},
     ["s.toml:6: ", 'ping.period_s is a string ("30"); it takes a number in s']),
    ("a number for a flag", SMALL + "[ping]\nidentified = 1\n", {},
     ["s.toml:6: ", "ping.identified is an integer; it takes true or false"]),
    ("a fraction for a count", SMALL + "[quality]\nlayers = 1.5\n", {},
     ["s.toml:6: ", "quality.layers is a number; it takes an integer"]),
    ("a value for a table", SMALL + "[faults]\nnode_loss = 3\n", {},
     ["s.toml:6: ", "faults.node_loss is an integer; it takes a table"]),
    ("a value for a choice", 'behaviour = "rigid_registration"\n' + SMALL, {},
     ["s.toml:1: ", "behaviour is a string", 'behaviour.kind = "..."']),
    ("a number for a kind", SMALL + "[behaviour]\nkind = 3\n", {},
     ["s.toml:6: ", "behaviour.kind is an integer; it takes a string"]),
    ("a date", SMALL + "[ping]\nperiod_s = 2014-12-01\n", {}, ["s.toml:6: ", "date"]),
    ("an unknown kind", SMALL + '[behaviour]\nkind = "rigid_registraton"\n', {},
     ["s.toml:6: ", 'no behaviour "rigid_registraton"', 'did you mean "rigid_registration"?']),
    ("an unknown kind deep down",
     SMALL + '[behaviour]\nkind = "attraction_repulsion"\n'
     'attraction_repulsion = { potential.kind = "none" }\n', {},
     ["s.toml:7: ", "behaviour.attraction_repulsion.potential.kind", 'no potential "none"']),
    ("a solver of its old name", REPELLED + 'solver.kind = "nlopt_mma"\n', {},
     ['s.toml:7: behaviour.attraction_repulsion.solver.kind: there is no solver "nlopt_mma"; '
      'did you mean "nlopt.mma"?\n']),
    ("a library for a solver", REPELLED + 'solver.kind = "nlopt"\n', {},
     ["s.toml:7: ", 'there is no solver "nlopt"; did you mean one of nlopt.bobyqa, nlopt.ccsaq, ']),
    ("a solver of no such library", REPELLED + "solver.nlop.mma.max_evaluations = 9\n", {},
     ['s.toml:7: behaviour.attraction_repulsion.solver has no option "nlop"; did you mean '
      '"nlopt"?\n']),
    ("a solver that its library has not", REPELLED + "solver.nlopt.mna.max_evaluations = 9\n", {},
     ['s.toml:7: behaviour.attraction_repulsion.solver.nlopt has no option "mna"; did you mean '
      '"mma"?\n']),
    ("a solver's option that is none", REPELLED + "solver.nlopt.mma.max_evaluation = 9\n", {},
     ['s.toml:7: behaviour.attraction_repulsion.solver.nlopt.mma has no option "max_evaluation"; '
      'did you mean "max_evaluations"?\n']),
    ("a solver's option out of range", REPELLED + "solver.nlopt.mma.max_evaluations = 0\n", {},
     ["s.toml:7: behaviour.attraction_repulsion.solver.nlopt.mma.max_evaluations is 0; "]),
    ("a solver in quotes", REPELLED + 'solver."nlopt.mma".max_evaluations = 9\n', {},
     ['s.toml:7: behaviour.attraction_repulsion.solver has no option "nlopt.mma"; write '
      "behaviour.attraction_repulsion.solver.nlopt.mma without quotes\n"]),
    ("an unknown word", SMALL + '[quality]\nalignment = "middle"\n', {},
     ["s.toml:6: ", 'quality.alignment has no value "middle"', "known are centroid"]),
    ("nan", SMALL + "[ping]\nperiod_s = nan\n", {}, ["s.toml:6: ", "ping.period_s is nan"]),
    ("inf", SMALL + "[ping]\nperiod_s = inf\n", {}, ["s.toml:6: ", "ping.period_s is inf"]),
    ("less than nothing", SMALL + "[ping]\nperiod_s = -30\n", {},
     ["s.toml:6: ", "ping.period_s is -30; it takes above 0 s"]),
    ("out of range", SMALL + "[ping]\nloss_probability = 1.5\n", {},
     ["s.toml:6: ", "ping.loss_probability is 1.5; it takes from 0 to 1"]),
    ("parts of a tick", SMALL + "[guidance]\nperiod_s = 0.3\n", {},
     ["s.toml:6: ", "guidance.period_s is 0.3 s; it must be a multiple of trial.tick_s = 0.25 s"]),
    ("a duration in parts of a tick", "[trial]\nduration_s = 60.1\n", {},
     ["s.toml:2: ", "trial.duration_s is 60.1 s; it must be a multiple"]),
    ("a record in parts of a tick", "[trial]\nrecord_every_s = 0.3\n", {},
     ["s.toml:2: ", "trial.record_every_s is 0.3 s; it must be a multiple"]),
    ("losses in parts of a tick", SMALL + "[faults.node_loss]\ncount = 1\nevery_s = 0.3\n", {},
     ["s.toml:7: ", "faults.node_loss.every_s is 0.3 s; it must be a multiple"]),
    ("a tick that fits nothing", "[trial]\ntick_s = 0.06\n", {},
     ["s.toml:2: ", "guidance.period_s is 0.25 s", "trial.tick_s = 0.06 s"]),
    ("more ticks than can be counted", "[trial]\nduration_s = 1e300\n", {},
     ["s.toml:2: ", "trial.duration_s is 1e+300 s; it must be at most"]),
    ("an endless pause", SMALL + "[ping]\nperiod_s = 1e300\n", {},
     ["s.toml:6: ", "ping.period_s is 1e+300 s; it must be at most"]),
    ("pings within a tick", SMALL + "[ping]\nperiod_s = 0.1\n", {},
     ["s.toml:6: ", "ping.period_s is 0.1 s; it must be at least trial.tick_s"]),
    ("a start that is no date", '[trial]\nstart = "tomorrow"\n', {},
     ["s.toml:2: ", "trial.start", '"tomorrow" is no date', "2014-12-01T00:00:00Z"]),
    ("losses at no time", SMALL + "[faults.node_loss]\ncount = 1\n", {},
     ["s.toml:5: ", "faults.node_loss", "every_s must be above 0"]),
    ("a vehicle's step that divides nothing",
     SMALL + "[swarm.vehicle.drifter]\nstep_s = 0.07\n", {}, ["s.toml:5: ", "step_s"]),
    ("ids needed and not given", SMALL + "[ping]\nidentified = false\n", {},
     ["s.toml:6: ", "behaviour rigid_registration needs", "set ping.identified = true"]),
    ("a rest longer than the period",
     SMALL + '[behaviour]\nkind = "assignment_registration"\n'
     "[ping]\nidentified = false\n[ping_filter]\nrest_s = 40\n", {},
     ["s.toml:10: ", "ping_filter.rest_s must be shorter than ping.period_s"]),
    ("no vehicles", "[plan]\nsquare.rows = 0\n", {}, ["s.toml:2: ", "plan.square.rows is 0"]),
    ("one vehicle", "[plan]\nsquare = { rows = 1, columns = 1 }\n", {},
     ["s.toml:", "one slot", "at least two"]),
    ("too many vehicles for the quality", "[plan]\nsquare = { rows = 30, columns = 30 }\n", {},
     ["s.toml:1: ", "quality of 900 vehicles", "set quality.every_s = 0"]),
    ("a plan without a file", '[plan]\nkind = "file"\n', {}, ["s.toml:2: ", "plan.file.path"]),
    ("a plan's file that is not there", FILE_PLAN, {}, ["s.toml:5: ", "plan.csv"]),
    ("a plan with a name twice", FILE_PLAN, {"plan.csv": "name,x_m,y_m\na,0,0\na,1,1\n"},
     ["plan.csv:3: ", "same name"]),
    ("a plan with two slots in one place", FILE_PLAN,
     {"plan.csv": "name,x_m,y_m\na,0,0\nb,0,0\n"}, ["plan.csv:3: ", "same place"]),
    ("a plan with nan", FILE_PLAN, {"plan.csv": "name,x_m,y_m\na,0,0\nb,nan,0\n"},
     ["plan.csv:3: ", "x_m", "nan"]),
    ("a plan without a name", FILE_PLAN, {"plan.csv": "name,x_m,y_m\na,0,0\n,1,1\n"},
     ["plan.csv:3: ", "name is empty"]),
    ("a plan with a strange column", FILE_PLAN, {"plan.csv": "name,x,y_m\na,0,0\n"},
     ["plan.csv:1: ", 'no column "x"', 'did you mean "x_m"?']),
    ("an empty plan", FILE_PLAN, {"plan.csv": ""}, ["plan.csv: ", "empty"]),
    ("a slot without a place", '[plan]\nkind = "nodes"\nnodes.nodes = ["name = a, x = 1"]\n', {},
     ["s.toml:", "y is missing"]),
    ("a start without a file", SMALL + '[swarm]\nstart.kind = "file"\n', {},
     ["s.toml:6: ", "swarm.start.file.path"]),
    ("a start's file that is not there", FILE_START, {}, ["s.toml:7: ", "starts.csv"]),
    ("starts with nan", FILE_START, starts("NODE_2,nan,0"), ["starts.csv:3: ", "x_m", "nan"]),
    ("starts of a stranger", FILE_START, starts("NODE_7,1,0"),
     ["starts.csv:3: ", '"NODE_7"', "it has NODE_1"]),
    ("starts that lack one", FILE_START, starts("#"), ["starts.csv: ", "no start for NODE_2"]),
    ("starts with one twice", FILE_START, starts("NODE_1,1,0"),
     ["starts.csv:3: ", "NODE_1 starts twice"]),
    ("starts in one place", FILE_START, starts("NODE_2,0,0"),
     ["starts.csv: ", "NODE_1 and NODE_2 both start at (0, 0)"]),
    ("points in one place", POINTS + "points.points = [[0, 0], [1, 1], [0, 0], [2, 2]]\n", {},
     ["s.toml:7: ", "NODE_1 and NODE_3 both start at (0, 0)"]),
    ("too few points", POINTS + "points.points = [[0, 0]]\n", {}, ["s.toml:7: ", "1 point"]),
    ("points with nan", POINTS + "points.points = [[0, 0], [1, nan], [3, 0], [2, 2]]\n", {},
     ["s.toml:7: ", "nan"]),
    ("points that are no pairs", POINTS + "points.points = [[0, 0, 0]]\n", {},
     ["s.toml:7: ", "[x, y] pairs"]),
    ("points beyond the sea", POINTS + "points.points = [[0, 0], [1, 1], [1e300, 0], [2, 2]]\n",
     {}, ["s.toml:7: ", "NODE_3", "1e+300"]),
    ("no current file named", SMALL + '[current]\nkind = "netcdf"\n', {},
     ["s.toml:6: ", "current.netcdf", "file"]),
    ("a current file that is not there", OTHER_SEA, {}, ["s.toml:7: ", "sea.nc"]),
    ("a current file that is text", OTHER_SEA, {"sea.nc": "hello"},
     ["s.toml:7: ", "sea.nc: is not a netCDF file"]),
    ("a current file that is empty", OTHER_SEA, {"sea.nc": ""}, ["s.toml:7: ", "sea.nc"]),
    ("a current that ends", RED_SEA + "netcdf.time_offset_s = 1e7\n", {},
     ["s.toml:7: ", "redsea_like.nc: no current at t = 0 s: the file ends", "duration_s"]),
    ("a current that has not begun", RED_SEA + "netcdf.time_offset_s = -10\n", {},
     ["s.toml:7: ", "the file begins at", "time_offset_s"]),
    ("a current that is elsewhere", RED_SEA + "[swarm]\nstart.box.side_m = 1e6\n", {},
     ["s.toml:7: ", "the file covers x from"]),
    ("a current's date that is none", RED_SEA + 'netcdf.start = "tomorrow"\n', {},
     ["s.toml:7: ", "current.netcdf.start", '"tomorrow"']),
]

# Arguments behind `shoal`, and what the complaint must say.
BAD_ARGUMENTS = [
    ([], ["subcommand is required", "--help"]),
    (["frobnicate"], ["--help"]),
    (["run"], ["scenario is required"]),
    (["run", "redsea_sqare"], ['no file "redsea_sqare"', 'did you mean "redsea_square"?']),
    (["run", ""], ['no file ""']),
    (["run", "."], ["directory"]),
    (["run", "ok.toml", "--frobnicate"], ["--frobnicate"]),
    (["run", "ok.toml", "--set", "trial.seed"], ["--set trial.seed: ", "KEY=VALUE"]),
    (["run", "ok.toml", "--set", "=3"], ["--set =3: ", "KEY=VALUE"]),
    (["run", "ok.toml", "--set", "trial.sed=3"], ["--set trial.sed=3: ", 'did you mean "seed"?']),
    (["run", "ok.toml", "--set", "trial..seed=3"], ["not a dotted key"]),
    (["run", "ok.toml", "--set", "trial.seed=[1,"], ["not a TOML value"]),
    (["run", "ok.toml", "--set", "trial.seed=a\nb"], ['a string ("a\\x0ab")', "an integer"]),
    (["run", "ok.toml", "--set", "trial=3"], ["trial is an integer; it takes a table"]),
    (["run", "ok.toml", "--set", "plan.square.rows=9223372036854775807"],
     ["plan.square.rows is 9223372036854775807; it takes from 1"]),
    (["run", "ok.toml", "--seed", "-1"], ["trial.seed is -1; it takes from 0"]),
    (["run", "ok.toml", "--seed", "99999999999999999999"], ["99999999999999999999", "integer"]),
    (["run", "ok.toml", "--seed", "1.5"], ["trial.seed is a number; it takes an integer"]),
    (["run", "ok.toml", "--threads", "0"], ["--threads", "1 to 1024"]),
    (["run", "ok.toml", "--out", ""], ["--out"]),
    (["run", "ok.toml", "--set",
      "behaviour.attraction_repulsion.solver.nlopt.mma.max_evaluations=0"],
     ["--set behaviour.attraction_repulsion.solver.nlopt.mma.max_evaluations=0: behaviour."
      "attraction_repulsion.solver.nlopt.mma.max_evaluations is 0; it takes from 1 to 1e+09\n"]),
    (["list", "behavior"], ['no family "behavior"', 'did you mean "behaviour"?']),
    (["list", "solvres"], ['no family "solvres"', 'did you mean "solver"?']),
    (["list", "everything"], ['no family "everything"', "known are behaviour, cohesion, current, "]),
    (["describe"], ["required"]),
    (["describe", "rigid"], ['"rigid"', 'did you mean "rigid_registration"?']),
    (["describe", "quux quux"], ["shoal list"]),
    (["describe", "ping.perod_s"], ["ping has no option", 'did you mean "period_s"?']),
    (["describe", "ping.period_s.x"], ["ping.period_s is a number"]),
    (["describe", "behaviour.rigid.x"], ['did you mean "rigid_registration"?']),
    (["describe", "."], ['no option ""']),
    (["describe", "pin.period_s"], ['a scenario has no option "pin"; did you mean "ping"?']),
    (["describe", "nlopt.lbgfs"], ['nothing is called "nlopt.lbgfs"; did you mean "nlopt.lbfgs"?']),
    (["describe", "nlopt"],
     ['nothing is called "nlopt"; did you mean one of nlopt.bobyqa, ', " and nlopt.var2?"]),
    (["describe", "nlopt_lbfgs"], ['did you mean "nlopt.lbfgs"?']),
    (["describe", "behaviour.attraction_repulsion.solver.nlopt"],
     ['behaviour.attraction_repulsion.solver: there is no solver "nlopt"; did you mean one of ']),
    (["describe", "behaviour.attraction_repulsion.solver.nlopt.lbgfs.max_evaluations"],
     ['there is no solver "nlopt.lbgfs"; did you mean "nlopt.lbfgs"?']),
    (["describe", "behaviour.attraction_repulsion.solver.nlopt.lbfgs.evaluations"],
     ['behaviour.attraction_repulsion.solver.nlopt.lbfgs has no option "evaluations"']),
    (["solve"], ["required"]),
    (["solve", "missing.jsonl"], ["--solvers is required"]),
    (["solve", "missing.jsonl", "--solvers", "newton"], ["cannot open missing.jsonl"]),
    (["solve", "notes.txt", "--solvers", "newton"], ["notes.txt: holds no problem"]),
    (["solve", "ok.toml", "--solvers", "newton"],
     ["ok.toml:1: this is no line of a corpus; shoal run --record-problems writes one"]),
    (["solve", "ok.toml", "--solvers", "newtn"],
     ['there is no solver "newtn"; did you mean "newton"?']),
    (["solve", "ok.toml", "--solvers", "newton", "--format", "pdf"],
     ['there is no format "pdf"', "text, csv, markdown and latex"]),
    (["solve", "ok.toml", "--solvers", "newton", "--set", "newton.max_evaluations=3"],
     ['there is no family of solvers "newton"', "known are solver, registration and matching"]),
    (["solve", "ok.toml", "--solvers", "newton", "--set", "solver.newton.max_evaluation=3"],
     ['solver.newton has no option "max_evaluation"; did you mean "max_evaluations"?']),
    (["solve", "ok.toml", "--solvers", "newton", "--reference", "grid"],
     ['the reference "grid" is not among the solvers']),
    (["solve", "ok.toml", "--solvers", "newton", "--same-within", "-1"], ["--same-within"]),
    (["corpus"], ["required"]),
    (["corpus", "c.jsonl", "--keep", "0"], ["--keep"]),
    (["corpus", "c.jsonl", "--duration", "-5"], ["trial.duration_s is -5"]),
    (["corpus", "c.jsonl", "--seed", "x"], ["trial.seed"]),
    (["check"], ["required"]),
    (["check", "missing.toml"], ["missing.toml"]),
    (["check", "missing.csv"], ["missing.csv"]),
    (["check", "missing.nc"], ["missing.nc"]),
    (["check", "notes.txt"], ["notes.txt", ".toml, .csv and .nc"]),
    (["check", "ok.toml", "bad.csv"], ["bad.csv", "two slots named a"]),
    (["check", "bad.nc"], ["bad.nc", "not a netCDF file"]),
]


class Desk(unittest.TestCase):
    """A folder of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.desk = pathlib.Path(folder.name)
        self.write("ok.toml", SMALL)

    def write(self, name, content):
        file = self.desk / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())

    def files(self):
        return {str(f.relative_to(self.desk)) for f in self.desk.rglob("*") if f.is_file()}

    def shoal(self, *arguments, **settings):
        return subprocess.run([SHOAL, *map(str, arguments)], cwd=self.desk, capture_output=True,
                              text=True, timeout=60, check=False, **settings)

    def run_trial(self, *arguments, out="out"):
        done = self.shoal("run", *arguments, "--out", out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads((self.desk / out / "summary.json").read_text())

    def assert_complains(self, done, status, parts):
        """One line `shoal: ...` on stderr that says these things in this order."""
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertRegex(done.stderr, r"\Ashoal: [^\n]+\n\Z")
        rest = done.stderr
        for part in parts:
            self.assertIn(part, rest, done.stderr)
            rest = rest[rest.index(part) + len(part):]


class BadInput(Desk):
    def test_a_bad_scenario_is_refused_in_one_line(self):
        for title, scenario, files, parts in BAD_SCENARIOS:
            with self.subTest(title):
                self.setUp()
                self.write("s.toml", scenario)
                for name, content in files.items():
                    self.write(name, content)
                before = self.files()
                self.assert_complains(self.shoal("run", "s.toml", "--out", "out"), 2, parts)
                self.assertEqual(self.files(), before)

    def test_bad_arguments_are_refused_in_one_line(self):
        self.write("notes.txt", "")
        self.write("bad.csv", "name,x_m,y_m\na,0,0\na,1,1\n")
        self.write("bad.nc", "no netCDF")
        before = self.files()
        for arguments, parts in BAD_ARGUMENTS:
            with self.subTest(" ".join(arguments)):
                self.assert_complains(self.shoal(*arguments), 2, parts)
                self.assertEqual(self.files(), before)

    def test_an_earlier_result_outlives_bad_input(self):
        self.run_trial("ok.toml")
        before = (self.desk / "out/summary.json").read_bytes()
        self.assertEqual(self.shoal("run", "ok.toml", "--seed", "x", "--out", "out").returncode, 2)
        self.assertEqual((self.desk / "out/summary.json").read_bytes(), before)


class BadSurroundings(Desk):
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

    def test_a_terminal_that_takes_nothing(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([SHOAL, "list", "behaviour"], stdout=full, check=False,
                                  stderr=subprocess.PIPE, text=True)
        self.assert_complains(done, 1, ["cannot write"])


    def test_files_that_cannot_be_written_are_refused_before_the_work(self):
        for arguments in (["corpus", "ok.toml/c.jsonl"],
                          ["run", "ok.toml", "--record-problems", "ok.toml/c.jsonl"]):
            self.assert_complains(self.shoal(*arguments), 1,
                                  ["cannot write into ", "choose another place for ok.toml/c.jsonl"])
        self.assert_complains(self.shoal("corpus", "."), 1, ["cannot write .: it is a folder"])

    def test_no_folder_is_made_for_profiles_of_a_corpus_that_is_none(self):
        self.assert_complains(self.shoal("solve", "ok.toml", "--solvers", "newton", "--profiles",
                                         "new/p.csv"), 2, ["ok.toml:1: "])
        self.assertFalse((self.desk / "new").exists())


class Help(Desk):
    def say(self, *arguments):
        done = self.shoal(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_help_names_the_commands(self):
        for command in ["run", "list", "describe", "check", "corpus", "solve"]:
            self.assertIn(command, self.say("--help"))
            self.assertIn("--help", self.say(command, "--help"))

    def test_version(self):
        self.assertRegex(self.say("--version"), r"\Ashoal \d+\.\d+\.\d+\n\Z")

    def test_list_shows_every_family_and_scenario(self):
        everything = self.say("list")
        for name in [*BEHAVIOURS, "netcdf", "hexagonal", "drifter", "redsea_square", "letters_nr"]:
            self.assertIn(f"  {name}", everything)
        self.assertNotIn("netcdf", self.say("list", "behaviour"))

    def test_list_takes_a_family_in_the_plural_too(self):
        for one, many in [("behaviour", "behaviours"), ("solver", "solvers"), ("loss", "losses"),
                          ("scenario", "scenarios")]:
            self.assertEqual(self.say("list", one), self.say("list", many))
        self.assertIn("  nlopt.lbfgs ", self.say("list", "solvers"))

    def test_describe_a_member_says_which_keys_set_it(self):
        text = self.say("describe", "rigid_registration")
        self.assertIn("behaviour.rigid_registration.ownship_weight\n", text)
        self.assertIn("default 1.0", text)

    def test_describe_a_key(self):
        key = "behaviour.assignment_registration.delta_theta_deg"
        text = self.say("describe", key)
        self.assertTrue(text.startswith(key + "\n"))
        self.assertIn("takes a number above 0 and at most 180 deg; default 45.0", text)

    def test_describe_a_member_whose_name_has_a_dot(self):
        path = "behaviour.attraction_repulsion.solver.nlopt.lbfgs"
        text = self.say("describe", "nlopt.lbfgs")
        self.assertTrue(text.startswith("nlopt.lbfgs (solver): NLopt: "))
        self.assertIn(path + ".max_evaluations\n", text)
        self.assertEqual(self.say("describe", path), text)
        option = self.say("describe", path + ".max_evaluations")
        self.assertTrue(option.startswith(path + ".max_evaluations\n"))
        self.assertIn("takes an integer from 1 to 1e+09; default ", option)
        self.assertIn(option, text)
        choice = self.say("describe", "behaviour.attraction_repulsion.solver.kind")
        self.assertIn("  nlopt.bobyqa ", choice)

    def test_describe_a_table(self):
        text = self.say("describe", "ping")
        for part in ["ping.period_s\n", "above 0 s; default 30.0", '"synchronous", "staggered"']:
            self.assertIn(part, text)

    def test_describe_a_choice_lists_its_members(self):
        for name in ["behaviour", "behaviour.kind"]:
            for behaviour in BEHAVIOURS:
                self.assertIn(f"  {behaviour} ", self.say("describe", name))

    def test_describe_finds_both_an_option_and_a_member_of_that_name(self):
        text = self.say("describe", "plan")
        self.assertIn("plan.kind\n", text)
        self.assertIn("plan (start)", text)

    def test_a_described_scenario_is_a_scenario(self):
        self.write("copy.toml", self.say("describe", "redsea_square"))
        self.assertIn("20 vehicles", self.say("check", "copy.toml"))

    def test_every_scenario_of_the_library_checks(self):
        names = [line.strip() for line in self.say("list", "scenario").splitlines()[1:]]
        self.assertGreaterEqual(len(names), 10)
        self.assertEqual(self.say("check", *names).count("a scenario of"), len(names))

    def test_check_says_what_files_hold(self):
        self.write("plan.csv", "name,x_m,y_m\na,0,0\nb,9,0\n")
        self.write("starts.csv", "name,x_m,y_m,heading_deg\na,0,0,90\nb,9,0,90\n")
        text = self.say("check", "plan.csv", "starts.csv", "ok.toml")
        self.assertIn("plan.csv: a plan, or starts, of 2 vehicles", text)
        self.assertIn("starts.csv: starts of 2 vehicles", text)
        self.assertIn("ok.toml: a scenario of 4 vehicles, rigid_registration", text)


class Trials(Desk):
    def test_a_solver_whose_name_has_a_dot_is_set_from_a_file_and_by_hand(self):
        path = "behaviour.attraction_repulsion.solver"
        self.write("s.toml", REPELLED + 'solver.kind = "nlopt.slsqp"\n'
                   f"[{path}.nlopt.slsqp]\nmax_evaluations = 300\n"
                   f"[{path}.nlopt.mma]\nmax_evaluations = 30\n")
        self.run_trial("s.toml", out="file")
        resolved = (self.desk / "file/scenario.toml").read_text()
        self.assertIn(f'[{path}]\nkind = "nlopt.slsqp"\n', resolved)
        self.assertIn(f"[{path}.nlopt.slsqp]\nmax_evaluations = 300\n", resolved)
        self.assertIn(f"[{path}.nlopt.mma]\nmax_evaluations = 30\n", resolved)
        self.run_trial("file/scenario.toml", out="again")
        self.assertEqual((self.desk / "again/scenario.toml").read_text(), resolved)

        self.run_trial("s.toml", "--set", f"{path}.kind=nlopt.mma", "--set",
                       f"{path}.nlopt.mma.max_evaluations=31", out="hand")
        by_hand = (self.desk / "hand/scenario.toml").read_text()
        self.assertIn(f'[{path}]\nkind = "nlopt.mma"\n', by_hand)
        self.assertIn(f"[{path}.nlopt.mma]\nmax_evaluations = 31\n", by_hand)

    def test_a_trial_leaves_its_scenario_its_record_and_its_summary(self):
        summary = self.run_trial("redsea_square", "--set", "trial.duration_s=300")
        self.assertEqual(self.files(), {"ok.toml", "out/scenario.toml", "out/run.nc",
                                        "out/summary.json"})
        self.assertEqual(list(summary), BESIDE)
        self.assertEqual(set(summary["metrics"]), set(METRICS))
        self.assertEqual((summary["scenario"], summary["behaviour"], summary["vehicles"]),
                         ("redsea_square", "rigid_registration", 20))
        self.assertEqual((summary["seed"], summary["duration_s"]), (1, 300))
        metrics = summary["metrics"]
        for name, value in metrics.items():
            if name != "time_to_quality_20m_s":
                self.assertTrue(np.isfinite(value), name)
        self.assertLess(metrics["energy_min_wh"], metrics["energy_mean_wh"])
        self.assertLess(metrics["energy_mean_wh"], metrics["energy_max_wh"])
        self.assertGreater(metrics["centroid_path_m"], metrics["centroid_displacement_m"])

    def test_recorded_problems_leave_the_numbers_alone(self):
        short = ["construction_square", "--set", "trial.duration_s=300"]
        plain = self.run_trial(*short)["metrics"]
        for threads in ("1", "3"):
            file = f"problems{threads}.jsonl"
            done = self.shoal("run", *short, "--threads", threads, "--out", "recorded",
                              "--record-problems", file)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn(f"written: {file}, ", done.stdout)
            metrics = json.loads((self.desk / "recorded/summary.json").read_text())["metrics"]
            self.assertEqual(metrics, plain)
        one, many = (self.desk / f"problems{n}.jsonl" for n in (1, 3))
        self.assertEqual(one.read_bytes(), many.read_bytes())

    def test_solvers_are_compared_on_recorded_problems_in_four_formats(self):
        for behaviour in BEHAVIOURS:
            self.shoal("run", "construction_square", "--set", "trial.duration_s=90", "--set",
                       f"behaviour.kind={behaviour}", "--out", "o", "--record-problems",
                       f"{behaviour}.jsonl")
            solvers = "newton,nlopt.slsqp,grid,procrustes,sampled"
            arguments = ["solve", f"{behaviour}.jsonl", "--solvers", solvers]
            text = self.shoal(*arguments)
            self.assertEqual((text.returncode, text.stderr), (0, ""))
            head = text.stdout.splitlines()[0]
            for column in ("solved %", "same minimum %", "other minimum %", "evaluations",
                           "median us", "p95 us", "worst gap", "not solved"):
                self.assertIn(column, head)
            csv = self.shoal(*arguments, "--format", "csv", "--profiles", "profiles.csv").stdout
            rows = [line.split(",") for line in csv.splitlines()[1:]]
            self.assertTrue(rows)
            for row in rows:
                wanted = "0.00" if row[1] == "grid" else "100.00"
                if row[1] != "nlopt.slsqp":
                    self.assertEqual(row[3], wanted, row)
            if behaviour == "attraction_repulsion":
                self.assertIn("refused: needs finite bounds", csv)
            profiles = (self.desk / "profiles.csv").read_text().splitlines()
            self.assertEqual(profiles[0], "family,measure,solver,factor,share")
            self.assertGreater(len(profiles), 50)
            markdown = self.shoal(*arguments, "--format", "markdown").stdout
            self.assertTrue(markdown.splitlines()[1].startswith("|---"))
            self.assertIn("\\toprule", self.shoal(*arguments, "--format", "latex").stdout)

    def test_a_corpus_holds_problems_of_every_scenario_and_behaviour(self):
        done = self.shoal("corpus", "c.jsonl", "--duration", "60", "--keep", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        heads = [json.loads(line) for line in (self.desk / "c.jsonl").read_text().splitlines()]
        heads = [head for head in heads if "plan" in head]
        scenarios = self.shoal("list", "scenarios").stdout.splitlines()[1:]
        self.assertEqual(len(heads), len(scenarios) * len(BEHAVIOURS))
        again = self.shoal("corpus", "d.jsonl", "--duration", "60", "--keep", "2")
        self.assertEqual(again.returncode, 0)
        self.assertEqual((self.desk / "c.jsonl").read_bytes(),
                         (self.desk / "d.jsonl").read_bytes())

    def test_every_local_solver_flies_a_swarm(self):
        key = "behaviour.attraction_repulsion.solver.kind"
        solvers = [line.split()[0] for line in
                   self.shoal("list", "solvers").stdout.splitlines()[1:]]
        flown = []
        for solver in solvers:
            done = self.shoal("run", "construction_hexagonal", "--set", "trial.duration_s=120",
                              "--set", "behaviour.kind=attraction_repulsion", "--set",
                              f"{key}={solver}", "--out", solver)
            if done.returncode == 0:
                flown.append(solver)
                continue
            self.assert_complains(done, 2, [f"solver.{solver}: ", "needs", "; choose a solver"])
        self.assertEqual(set(solvers) - set(flown),
                         {"ceres.least_squares", "grid", "nlopt.crs2", "nlopt.direct_l",
                          "nlopt.isres", "nlopt.mlsl", "nlopt.stogo"})

    def test_the_written_scenario_runs_again_to_the_same_numbers(self):
        first = self.run_trial("redsea_square", "--set", "trial.duration_s=300", "--seed", "5",
                               "--set", "behaviour.kind=pairwise_referencing")
        self.assertEqual(first["seed"], 5)
        again = self.run_trial("out/scenario.toml", out="again")
        self.assertEqual(again["metrics"], first["metrics"])
        self.assertEqual((self.desk / "again/scenario.toml").read_text(),
                         (self.desk / "out/scenario.toml").read_text())

    def test_another_seed_gives_other_numbers(self):
        one, two = (self.run_trial("ok.toml", "--seed", seed)["metrics"] for seed in (1, 2))
        self.assertNotEqual(one["min_separation_m"], two["min_separation_m"])

    def test_the_numbers_depend_neither_on_threads_nor_on_recording(self):
        many = ["ok.toml", "--set", "plan.square={rows=15,columns=15}", "--set",
                "quality.every_s=0", "--set", "trial.duration_s=120"]
        one = self.run_trial(*many)
        four = self.run_trial(*many, "--threads", "4", out="four")
        silent = self.run_trial(*many, "--set", "trial.record_every_s=0", out="silent")
        self.assertEqual(one["metrics"], four["metrics"])
        self.assertEqual(one["metrics"], silent["metrics"])
        self.assertIsNone(one["metrics"]["quality_final_m"])
        self.assertFalse((self.desk / "silent/run.nc").exists())
        with xarray.open_dataset(self.desk / "out/run.nc") as a, \
                xarray.open_dataset(self.desk / "four/run.nc") as b:
            xarray.testing.assert_identical(a, b)

    def test_set_switches_among_the_behaviours(self):
        paths = set()
        for kind in BEHAVIOURS:
            summary = self.run_trial("redsea_square", "--set", "trial.duration_s=240",
                                     "--set", f"behaviour.kind={kind}")
            self.assertEqual(summary["behaviour"], kind)
            paths.add(summary["metrics"]["energy_mean_wh"])
        self.assertEqual(len(paths), len(BEHAVIOURS))

    def test_paths_are_relative_to_the_scenario_and_those_of_set_to_the_user(self):
        rows = "name,x_m,y_m\na,0,0\nb,100,0\nc,0,100\n"
        self.write("plans/plan.csv", rows + "d,100,100\n")
        self.write("here.csv", rows)
        self.write("plans/s.toml", FILE_PLAN)
        self.assertEqual(self.run_trial("plans/s.toml")["vehicles"], 4)
        self.assertEqual(self.run_trial("plans/s.toml", "--set", "plan.file.path=here.csv")
                         ["vehicles"], 3)


class Record(Desk):
    def setUp(self):
        super().setUp()
        self.summary = self.run_trial(
            "redsea_square", "--set", "trial.duration_s=600", "--set",
            "trial.start=2014-12-01T00:30:00Z", "--set", "faults.node_loss={every_s=200,count=2}")
        self.run_nc = xarray.open_dataset(self.desk / "out/run.nc")
        self.addCleanup(self.run_nc.close)

    def test_every_variable_has_its_unit_and_meaning_for_each_vehicle_and_time(self):
        self.assertEqual(self.run_nc.sizes["vehicle"], 20)
        self.assertEqual(self.run_nc.sizes["time"], 121)
        for name, unit in RECORDED.items():
            variable = self.run_nc[name]
            self.assertEqual(variable.dims, ("vehicle", "time"), name)
            self.assertEqual(variable.attrs["units"], unit, name)
            self.assertTrue(variable.attrs["long_name"], name)
        self.assertEqual(set(self.run_nc.data_vars), {*RECORDED, "quality"})

    def test_it_is_a_cf_trajectory_file(self):
        attributes = self.run_nc.attrs
        self.assertEqual((attributes["Conventions"], attributes["featureType"]),
                         ("CF-1.8", "trajectory"))
        self.assertEqual((attributes["behaviour"], attributes["seed"]),
                         ("rigid_registration", "1"))
        self.assertEqual(self.run_nc["vehicle"].attrs["cf_role"], "trajectory_id")
        self.assertEqual(self.run_nc["time"].attrs["standard_name"], "time")
        reason = self.run_nc["target_reason"].attrs
        self.assertEqual(len(reason["flag_meanings"].split()), len(reason["flag_values"]))

    def test_times_decode_and_vehicles_have_their_names(self):
        time = self.run_nc["time"].values
        self.assertEqual(time[0], np.datetime64("2014-12-01T00:30:00"))
        self.assertEqual(time[-1], np.datetime64("2014-12-01T00:40:00"))
        self.assertEqual(self.run_nc["vehicle"].values[2], "NODE_3")
        self.assertEqual(self.run_nc["quality"].dims, ("quality_time",))
        self.assertEqual(self.run_nc["quality_time"].values[1], np.datetime64("2014-12-01T00:30:30"))

    def test_lost_vehicles_are_missing_from_then_on(self):
        left = self.run_nc["x"].notnull().sum("vehicle").values
        self.assertEqual(sorted(set(left)), [18, 19, 20])
        self.assertTrue((np.diff(left) <= 0).all())
        self.assertEqual(self.summary["metrics"]["lost_vehicles"], 2)

    def test_it_agrees_with_the_summary(self):
        metrics = self.summary["metrics"]
        end = self.run_nc.isel(time=-1)
        left = end.where(end["x"].notnull(), drop=True)
        total = left["energy_propulsion"] + left["energy_hotel"] + left["energy_comms"]
        for found, name in [(total.mean(), "energy_mean_wh"), (total.max(), "energy_max_wh"),
                            (left["energy_hotel"].mean(), "energy_hotel_mean_wh"),
                            (left["energy_comms"].mean(), "energy_comms_mean_wh"),
                            (left["thrust_time"].mean() / 600, "thrust_time_ratio_mean"),
                            (left["thrust_distance"].mean() / left["distance"].mean(),
                             "thrust_distance_ratio_mean")]:
            self.assertAlmostEqual(float(found) / metrics[name], 1.0, 5, name)
        self.assertGreater(metrics["energy_propulsion_mean_wh"], 0.0)

        quality = self.run_nc["quality"].values
        self.assertEqual(quality[-1], metrics["quality_final_m"])
        self.assertAlmostEqual(quality[8:].mean(), metrics["quality_settled_m"], 9)

    def test_motion_and_energy_are_possible(self):
        kept = self.run_nc.where(self.run_nc["x"].isel(time=-1, drop=True).notnull(), drop=True)
        for name in ["energy_propulsion", "energy_hotel", "energy_comms", "thrust_time",
                     "distance", "thrust_distance"]:
            self.assertGreaterEqual(float(kept[name].diff("time").min()), 0.0, name)
        self.assertTrue((kept["thrust_distance"] <= kept["distance"] + 1e-3).all())
        step = np.hypot(kept["x"].diff("time"), kept["y"].diff("time"))
        self.assertLess(float(step.max()), 5 * 1.5)
        self.assertTrue(((kept["heading"] >= 0) & (kept["heading"] < 360)).all())


if __name__ == "__main__":
    SHOAL = os.path.abspath(sys.argv.pop(1))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    unittest.main()
