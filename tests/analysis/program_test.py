"""The `shoal` program as its user meets it.

    python3 program_test.py SHOAL        (the program; needs xarray and netCDF4)
"""

import json

import numpy as np
import xarray

import desk
from desk import Desk, FILE_PLAN, REPELLED

# What any trial of drifting vehicles has, however short. program_help_test.py compares the names of all
# measures with those of a summary.
ALWAYS = """energy_mean_wh energy_min_wh energy_max_wh energy_propulsion_mean_wh
energy_hotel_mean_wh energy_comms_mean_wh quality_final_m quality_settled_m quality_worst_m
quality_last_m quality_trend_m_per_h centroid_path_m centroid_displacement_m efficiency_m_per_wh
thrust_time_ratio_mean thrust_time_ratio_spread thrust_distance_ratio_mean formation_rotation_deg
min_separation_m fragments lost_vehicles energy_spread_wh energy_rate_w rotation_disagreement_deg""".split()
# Of trials with a waypoint, or vehicles that estimate their states.
ELSEWHERE = """arrived_vehicles stranded_share arrival_first_s clearance_min_m cell_error_rms_m
control_effort_m_s outside_envelope_share position_error_rms_m nees_mean fault_share""".split()
BESIDE = ["scenario", "behaviour", "seed", "program", "vehicles", "duration_s", "mission_s",
          "stopped_by", "wall_s",
          "vehicle_seconds_per_wall_s", "measures"]
BEHAVIOURS = ["assignment_registration", "attraction_repulsion", "pairwise_referencing",
              "rigid_registration"]


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
        self.assertEqual(self.files(), {"ok.toml", "out/scenario.toml", "out/run.nc", "out/series.nc",
                                        "out/summary.json", "out/report.html"})
        self.assertEqual(list(summary), BESIDE)
        self.assertEqual((summary["scenario"], summary["behaviour"], summary["vehicles"]),
                         ("redsea_square", "rigid_registration", 20))
        self.assertEqual((summary["seed"], summary["duration_s"]), (1, 300))
        measures = summary["measures"]
        for name in ALWAYS:
            self.assertTrue(np.isfinite(measures[name]), name)
        for name in ELSEWHERE:
            self.assertIsNone(measures[name], name)
        self.assertLess(measures["energy_min_wh"], measures["energy_mean_wh"])
        self.assertLess(measures["energy_mean_wh"], measures["energy_max_wh"])
        self.assertGreater(measures["centroid_path_m"], measures["centroid_displacement_m"])

    def test_recorded_problems_leave_the_numbers_alone(self):
        short = ["construction_square", "--set", "trial.duration_s=300"]
        plain = self.run_trial(*short)["measures"]
        for threads in ("1", "3"):
            file = f"problems{threads}.jsonl"
            done = self.shoal("run", *short, "--threads", threads, "--out", "recorded",
                              "--record-problems", file)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn(f"written: {file}, ", done.stdout)
            measures = json.loads((self.desk / "recorded/summary.json").read_text())["measures"]
            self.assertEqual(measures, plain)
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
            progress = (self.desk / "profiles_progress.csv").read_text().splitlines()
            self.assertEqual(progress[0], "family,measure,solver,effort,left,left_low,left_high")
            markdown = self.shoal(*arguments, "--format", "markdown").stdout
            self.assertTrue(markdown.splitlines()[1].startswith("|---"))
            self.assertIn("\\toprule", self.shoal(*arguments, "--format", "latex").stdout)

    def test_a_corpus_holds_problems_of_every_scenario_and_behaviour(self):
        done = self.shoal("corpus", "c.jsonl", "--duration", "60", "--keep", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        heads = [json.loads(line) for line in (self.desk / "c.jsonl").read_text().splitlines()]
        heads = [head for head in heads if "plan" in head]
        scenarios, behaviours = (self.shoal("list", family).stdout.splitlines()[1:]
                                 for family in ("scenarios", "behaviours"))
        self.assertEqual(len(heads), len(scenarios) * len(behaviours))
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
        self.assertLessEqual({"newton", "ipopt", "multistart", "ceres.bfgs", "ceres.lbfgs",
                              "nlopt.bobyqa", "nlopt.lbfgs", "nlopt.slsqp", "nlopt.praxis"},
                             set(flown))
        self.assertEqual({"ceres.least_squares", "grid", "nlopt.crs2", "nlopt.direct_l",
                          "nlopt.isres", "nlopt.mlsl", "nlopt.stogo"} & set(flown), set())

    def test_the_written_scenario_runs_again_to_the_same_numbers(self):
        first = self.run_trial("redsea_square", "--set", "trial.duration_s=300", "--seed", "5",
                               "--set", "behaviour.kind=pairwise_referencing")
        self.assertEqual(first["seed"], 5)
        again = self.run_trial("out/scenario.toml", out="again")
        self.assertEqual(again["measures"], first["measures"])
        self.assertEqual((self.desk / "again/scenario.toml").read_text(),
                         (self.desk / "out/scenario.toml").read_text())

    def test_another_seed_gives_other_numbers(self):
        one, two = (self.run_trial("ok.toml", "--seed", seed)["measures"] for seed in (1, 2))
        self.assertNotEqual(one["min_separation_m"], two["min_separation_m"])

    def test_the_numbers_depend_neither_on_threads_nor_on_recording(self):
        many = ["ok.toml", "--set", "plan.square={rows=15,columns=15}", "--set",
                "quality.every_s=0", "--set", "trial.duration_s=120"]
        one = self.run_trial(*many)
        four = self.run_trial(*many, "--threads", "4", out="four")
        silent = self.run_trial(*many, "--set", "trial.record_every_s=0", out="silent")
        self.assertEqual(one["measures"], four["measures"])
        self.assertEqual(one["measures"], silent["measures"])
        self.assertIsNone(one["measures"]["quality_final_m"])
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
            paths.add(summary["measures"]["energy_mean_wh"])
        self.assertEqual(len(paths), len(BEHAVIOURS))

    def test_paths_are_relative_to_the_scenario_and_those_of_set_to_the_user(self):
        rows = "name,x_m,y_m\na,0,0\nb,100,0\nc,0,100\n"
        self.write("plans/plan.csv", rows + "d,100,100\n")
        self.write("here.csv", rows)
        self.write("plans/s.toml", FILE_PLAN)
        self.assertEqual(self.run_trial("plans/s.toml")["vehicles"], 4)
        self.assertEqual(self.run_trial("plans/s.toml", "--set", "plan.file.path=here.csv")
                         ["vehicles"], 3)


if __name__ == "__main__":
    desk.main()
