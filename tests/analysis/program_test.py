"""The `shoal` program as its user meets it.

    python3 program_test.py SHOAL        (the program; needs xarray and netCDF4)
"""

import json

import numpy as np
import xarray

import desk
from desk import Desk, FILE_PLAN, REPELLED

METRICS = """energy_mean_wh energy_min_wh energy_max_wh energy_propulsion_mean_wh
energy_hotel_mean_wh energy_comms_mean_wh quality_final_m quality_settled_m time_to_quality_20m_s
centroid_path_m centroid_displacement_m efficiency_m_per_wh thrust_time_ratio_mean
thrust_time_ratio_min thrust_time_ratio_max thrust_distance_ratio_mean formation_rotation_deg
min_separation_m fragments lost_vehicles energy_spread_wh energy_rate_w quality_worst_m
quality_last_m quality_trend_m_per_h quality_oscillation_m quality_swing_m energy_to_quality_20m_wh
thrust_time_ratio_spread thrust_distance_ratio_min thrust_distance_ratio_max
thrust_distance_ratio_spread path_straightness rotation_disagreement_deg
rotation_disagreement_first_hour_deg""".split()
# Of trials with a way-point, or vehicles that estimate their states.
ELSEWHERE = """arrived_vehicles stranded_share arrival_first_s arrival_last_s arrival_spread_s clearance_min_m
cell_error_rms_m cell_error_worst_m cell_error_final_m control_effort_m_s outside_envelope_share position_error_rms_m
speed_error_rms_m_s heading_error_rms_deg nees_mean nees_inside_share fault_share
outlier_share""".split()
# What five minutes are too short for.
LATER = ["time_to_quality_20m_s", "energy_to_quality_20m_wh", "quality_oscillation_m",
         "quality_swing_m", "path_straightness"]
SERIES = {
    "quality": "m", "energy_mean_wh": "W h", "energy_min_wh": "W h", "energy_max_wh": "W h",
    "centroid_path_m": "m", "efficiency_m_per_wh": "m W-1 h-1", "thrust_time_ratio_mean": "1",
    "thrust_time_ratio_min": "1", "thrust_time_ratio_max": "1",
    "thrust_distance_ratio_mean": "1", "thrust_distance_ratio_min": "1",
    "thrust_distance_ratio_max": "1", "rotation_disagreement_deg": "degree"}
BESIDE = ["scenario", "behaviour", "seed", "program", "vehicles", "duration_s", "wall_s",
          "vehicle_seconds_per_wall_s", "metrics"]
BEHAVIOURS = ["assignment_registration", "attraction_repulsion", "pairwise_referencing",
              "rigid_registration"]
RECORDED = {
    "x": "m", "y": "m", "depth": "m", "heading": "degree", "speed": "m s-1", "thrusting": "1",
    "target_x": "m", "target_y": "m", "target_reason": "1", "energy_propulsion": "W h",
    "energy_hotel": "W h", "energy_comms": "W h", "thrust_time": "s", "distance": "m",
    "thrust_distance": "m"}


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

    def test_list_measures_shows_what_they_yield(self):
        text = self.say("list", "measures")
        for line in ["  energy ", "      energy_rate_w ", "      thrust_time_ratio_mean "]:
            self.assertIn("\n" + line, text)
        self.assertNotIn("energy_rate_w", self.say("list", "behaviour"))

    def test_describe_what_a_measure_yields(self):
        self.assertEqual(self.say("describe", "energy_rate_w"),
                         "energy_rate_w (value of a trial, in W): "
                         "mean power in the last 60 % of the mission\n")
        text = self.say("describe", "energy_mean_wh")
        self.assertIn("energy_mean_wh (value of a trial, in Wh): ", text)
        self.assertIn("energy_mean_wh (series of a trial, in Wh): ", text)
        self.assertIn("(value of a trial, a pure number)", self.say("describe", "fragments"))

    def test_describe_finds_both_a_measure_and_a_series_of_that_name(self):
        text = self.say("describe", "quality")
        for line in ["quality: how the formation quality is measured",
                     "quality (measure): ", "quality (series of a trial, in m): "]:
            self.assertIn(line, text)

    def test_what_list_measures_shows_is_what_a_run_says(self):
        self.write("brief.toml", "trial.duration_s = 60\n")
        metrics = self.run_trial("brief.toml")["metrics"]
        listed = self.say("list", "measures")
        for name in metrics:
            self.assertIn(f"      {name} ", listed)

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

    def test_a_trial_leaves_its_scenario_record_summary_and_report(self):
        summary = self.run_trial("redsea_square", "--set", "trial.duration_s=300")
        self.assertEqual(self.files(), {"ok.toml", "out/scenario.toml", "out/run.nc",
                                        "out/summary.json", "out/report.html"})
        self.assertEqual(list(summary), BESIDE)
        self.assertEqual(set(summary["metrics"]), set(METRICS + ELSEWHERE))
        self.assertEqual((summary["scenario"], summary["behaviour"], summary["vehicles"]),
                         ("redsea_square", "rigid_registration", 20))
        self.assertEqual((summary["seed"], summary["duration_s"]), (1, 300))
        metrics = summary["metrics"]
        for name, value in metrics.items():
            if name in ELSEWHERE:
                self.assertIsNone(value, name)
            elif name not in LATER:
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
            self.assertIn("solved_percent,same_minimum_percent,", csv.splitlines()[0])
            for row in rows:
                wanted = "0" if row[1] == "grid" else "100"
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
        self.assertEqual(len(heads), len(scenarios) * (len(BEHAVIOURS) + 2))
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
        for name, unit in SERIES.items():
            variable = self.run_nc[name]
            self.assertEqual(variable.dims, (name + "_time",))
            self.assertEqual(variable.attrs["units"], unit, name)
            self.assertTrue(variable.attrs["long_name"], name)
        self.assertEqual(set(self.run_nc.data_vars), {*RECORDED, *SERIES})

    def test_a_series_of_nothing_is_left_out(self):
        self.run_trial("redsea_square", "--set", "trial.duration_s=60", "--set",
                       "quality.every_s=0", out="short")
        with xarray.open_dataset(self.desk / "short/run.nc") as run_nc:
            self.assertEqual(set(run_nc.data_vars), {*RECORDED, *SERIES} - {"quality"})

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
    desk.main()
