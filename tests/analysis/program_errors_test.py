"""What the `shoal` program says to bad input.

    python3 program_errors_test.py SHOAL        (the program)
"""

import re

import desk
from desk import Desk, FILE_PLAN, REPELLED, SMALL

FILE_START = SMALL + '[swarm.start]\nkind = "file"\nfile.path = "starts.csv"\n'
POINTS = SMALL + '[swarm.start]\nkind = "points"\n'
RED_SEA = SMALL + '[current]\nkind = "netcdf"\nnetcdf.file = "library:currents/redsea_like.nc"\n'
OTHER_SEA = SMALL + '[current]\nkind = "netcdf"\nnetcdf.file = "sea.nc"\n'


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
     SMALL + "[behaviour.assignment_registration.matching.sampled]\ndelta_theta_deg = 0\n", {},
     ["s.toml:6: ", "delta_theta_deg is 0; it takes from 0.01 to 180 deg"]),
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
     ["s.toml:6: ", 'quality.alignment has no value "middle"', "known are rigid, centroid"]),
    ("nan", SMALL + "[ping]\nperiod_s = nan\n", {}, ["s.toml:6: ", "ping.period_s is nan"]),
    ("inf", SMALL + "[ping]\nperiod_s = inf\n", {}, ["s.toml:6: ", "ping.period_s is inf"]),
    ("less than nothing", SMALL + "[ping]\nperiod_s = -30\n", {},
     ["s.toml:6: ", "ping.period_s is -30; it takes above 0 s"]),
    ("out of range", SMALL + "[ping]\nloss.independent.probability = 1.5\n", {},
     ["s.toml:6: ", "ping.loss.independent.probability is 1.5; it takes from 0 to 1"]),
    ("parts of a tick", SMALL + "[guidance.drift]\nperiod_s = 0.3\n", {},
     ["s.toml:6: ", "guidance.drift.period_s is 0.3 s; it must be a multiple of trial.tick_s = 0.25 s"]),
    ("a guidance of version 0.1", SMALL + "[guidance]\nspeed_m_s = 0.5\n", {},
     ["s.toml:6: guidance.speed_m_s is now guidance.drift.speed_m_s; write that\n"]),
    ("a search of version 0.1", SMALL + "[behaviour.assignment_registration]\ndelta_theta_deg = 5\n",
     {}, ["s.toml:6: behaviour.assignment_registration.delta_theta_deg is now "
          "behaviour.assignment_registration.matching.sampled.delta_theta_deg; write that\n"]),
    ("a loss of version 0.1", SMALL + "[ping]\nloss_probability = 0.1\n", {},
     ["s.toml:6: ping.loss_probability is now ping.loss.independent.probability; write that\n"]),
    ("a speed of sound of version 0.1", SMALL + "[ping]\nsound_speed_m_s = 1480\n", {},
     ["s.toml:6: ping.sound_speed_m_s is now ping.propagation.straight.sound_speed_m_s; write that\n"]),
    ("a schedule of version 0.1", SMALL + '[ping]\nschedule = "staggered"\n', {},
     ["s.toml:6: ping.schedule is a string; it takes a table: ping.schedule.kind = "]),
    ("an envelope of version 0.1", SMALL + "[envelope]\nspeed_max_m_s = 1\n", {},
     ["s.toml:5: envelope is now guidance.conditioned_force.envelope; write that\n"]),
    ("forces that the guidance does not take",
     SMALL + '[behaviour]\nkind = "pair_forces"\n[planner]\nupdate = "tick"\n', {},
     ["s.toml:6: behaviour pair_forces gives forces, which guidance drift does not take; set "
      'guidance.kind = "conditioned_force"\n']),
    ("places that the guidance does not take", SMALL + '[guidance]\nkind = "conditioned_force"\n', {},
     ["s.toml:6: behaviour rigid_registration gives places, which guidance conditioned_force does "
      'not take; set guidance.kind = "drift"\n']),
    ("half a waypoint", SMALL + "[waypoint]\nx_m = 5\n", {},
     ["s.toml:5: waypoint: set both x_m and y_m\n"]),
    ("no waypoint to lead to", SMALL + '[behaviour]\nkind = "virtual_potential"\n', {},
     ["s.toml:6: behaviour virtual_potential leads to a waypoint; set waypoint.x_m and "
      "waypoint.y_m\n"]),
    ("a duration in parts of a tick", "[trial]\nduration_s = 60.1\n", {},
     ["s.toml:2: ", "trial.duration_s is 60.1 s; it must be a multiple"]),
    ("a record in parts of a tick", "[trial]\nrecord_every_s = 0.3\n", {},
     ["s.toml:2: ", "trial.record_every_s is 0.3 s; it must be a multiple"]),
    ("losses in parts of a tick", SMALL + "[faults.node_loss]\ncount = 1\nevery_s = 0.3\n", {},
     ["s.toml:7: ", "faults.node_loss.every_s is 0.3 s; it must be a multiple"]),
    ("a tick that fits nothing", "[trial]\ntick_s = 0.06\n", {},
     ["s.toml:2: ", "guidance.drift.period_s is 0.25 s", "trial.tick_s = 0.06 s"]),
    ("more ticks than can be counted", "[trial]\nduration_s = 1e300\n", {},
     ["s.toml:2: ", "trial.duration_s is 1e+300 s; it must be at most"]),
    ("more to record than can be kept", "[trial]\nduration_s = 1e9\nrecord_every_s = 0.25\n", {},
     ["trial.record_every_s is 0.25 s, and trial.duration_s 1e+09 s: that is 1.2e+12 numbers"]),
    ("more to measure than can be kept", "[trial]\nduration_s = 1e10\nrecord_every_s = 0\n", {},
     ["quality.every_s is 30 s, and trial.duration_s 1e+10 s"]),
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
    (["frobnicate"], ['there is no command "frobnicate"; known are run, sweep, ', "--help"]),
    (["swep", "delta_theta"], ['there is no command "swep"; did you mean "sweep"?']),
    (["run", "delta_theta"], ['"delta_theta" is a study; shoal sweep delta_theta runs its trials']),
    (["run", "a_study.toml"], ["a_study.toml: this is a study; shoal sweep runs its trials"]),
    (["run", "said.toml"], ["said.toml: this is a file of claims; name it in a study"]),
    (["check", "said.toml"], ["said.toml: this is a file of claims; name it in a study"]),
    (["sweep", "said.toml"], ["said.toml: this is a file of claims; name it in a study"]),
    (["run", "ok.toml", "--set", "quality.layers=100"],
     ["quality.layers = 100 pads the plan to 40804 slots, and at most 10000 are searched"]),
    (["run", "ok.toml", "--set", "quality.alignment=centroid", "--set", "quality.layers=49",
      "--set", "quality.delta_theta_deg=0.01"],
     ["quality.delta_theta_deg = 0.01 and 10000 slots are", "take larger steps or fewer layers"]),
    (["sweep", "redsea_square"],
     ['"redsea_square" is a scenario; shoal run redsea_square runs it']),
    (["sweep", "ok.toml"], ["ok.toml: this is a scenario; shoal run runs it"]),
    (["run"], ["scenario is required"]),
    (["run", "redsea_sqare"], ['no file "redsea_sqare"', 'did you mean "redsea_square"?']),
    (["run", ""], ["scenario: is empty"]),
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
    (["list", "everything"], ['no family "everything"', "known are behaviour, claim_test, cohesion, current, "]),
    (["describe"], ["required"]),
    (["describe", "rigid"], ['"rigid"', 'did you mean "rigid_registration"?']),
    (["describe", "quux quux"], ["shoal list"]),
    (["describe", "ping.perod_s"], ["ping has no option", 'did you mean "period_s"?']),
    (["describe", "ping.period_s.x"], ["ping.period_s is a number"]),
    (["describe", "behaviour.rigid.x"], ['did you mean "rigid_registration"?']),
    (["describe", "energy_maen_wh"], ['did you mean "energy_mean_wh"?']),
    (["describe", "."], ['no option ""']),
    (["describe", "pin.period_s"], ['a scenario has no option "pin"; did you mean "ping"?']),
    (["describe", "nlopt.lbgfs"], ['nothing is called "nlopt.lbgfs"; did you mean "nlopt.lbfgs"?']),
    (["describe", "nlopt"],
     ['nothing is called "nlopt"; did you mean one of nlopt.bobyqa, ', " and nlopt.var2?"]),
    (["describe", "potential.expresion"], ['did you mean "expression"?']),
    (["describe", "table.colums"], ['table has no option "colums"; did you mean "columns"?']),
    (["describe", "delta_thet"], ['did you mean "delta_theta"?']),
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
     ['there is no format "pdf"', "csv, html, latex, markdown and text"]),
    (["solve", "ok.toml", "--solvers", "newton", "--set", "newton.max_evaluations=3"],
     ['there is no family of solvers "newton"', "known are matching, registration and solver"]),
    (["solve", "ok.toml", "--solvers", "newton", "--set", "solver.newton.max_evaluation=3"],
     ['solver.newton has no option "max_evaluation"; did you mean "max_evaluations"?']),
    (["solve", "ok.toml", "--solvers", "newton", "--reference", "grid"],
     ['the reference "grid" is not among the solvers']),
    (["solve", "ok.toml", "--solvers", "newton", "--same-within", "-1"],
     ["--same-within: -1 is no number of at least 0"]),
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


class BadInput(Desk):
    def test_an_empty_value_stands_for_no_default(self):
        for command in (["run", "ok.toml"], ["sweep", "s.toml"], ["corpus", "c.jsonl"],
                        ["solve", "c.jsonl", "--solvers", "newton"], ["export", "out"]):
            for option in self.options_of(command[0]):
                with self.subTest(f"{command[0]} {option}"):
                    self.assert_complains(self.shoal(*command, option, ""), 2,
                                          [option, "is empty"])
            self.assert_complains(self.shoal(command[0], ""), 2, ["is empty"])
        self.assertEqual(self.files(), {"ok.toml"})

    def options_of(self, command):
        """The options that take a value."""
        text = self.shoal(command, "--help").stdout
        options = re.findall(r"^  (?:-\w,)?(--[a-z-]+) [A-Z{]", text, re.MULTILINE)
        self.assertGreater(len(options), 0, text)
        return options

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
        self.write("a_study.toml", 'title = "mine"\nscenario = "ok.toml"\n')
        self.write("said.toml", '[[claim]]\nsays = "so"\n')
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


if __name__ == "__main__":
    desk.main()
