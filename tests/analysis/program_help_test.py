"""What `shoal list`, `describe` and `check` tell.

    python3 program_help_test.py SHOAL
"""

import desk
from desk import Desk

BEHAVIOURS = ["assignment_registration", "attraction_repulsion", "pairwise_referencing",
              "rigid_registration"]


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
        key = "behaviour.assignment_registration.matching.sampled.delta_theta_deg"
        text = self.say("describe", key)
        self.assertTrue(text.startswith(key + "\n"))
        self.assertIn("takes a number from 0.01 to 180 deg; default 45.0", text)

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

    def test_describe_measures_and_their_options(self):
        text = self.say("describe", "measure")
        self.assertTrue(text.startswith(self.say("list", "measure")), text)
        self.assertRegex(text, r"measure.NAME.OPTION: options of measures; those that have some are\n +lattice +is the lattice whole")
        self.assertIn("measure.lattice.together_spacings\n", self.say("describe", "lattice"))
        text = self.say("describe", "measure.lattice.together_spacings")
        self.assertIn("takes a number above 0; default 1.5\n", text)

    def test_describe_a_table(self):
        text = self.say("describe", "ping")
        for part in ["ping.period_s\n", "above 0 s; default 30.0", "ping.schedule.kind\n"]:
            self.assertIn(part, text)

    def test_describe_tells_what_pings_and_faults_can_be(self):
        for choice, members in (("ping.schedule", ["synchronous", "staggered"]),
                                ("ping.loss", ["independent"]), ("ping.propagation", ["straight"]),
                                ("faults", ["node_loss"])):
            text = self.say("describe", choice)
            for member in members:
                self.assertIn(f"  {member} ", text)
        self.assertIn("ping.loss.independent.probability\n", self.say("describe", "independent"))

    def test_describe_a_choice_lists_its_members(self):
        for name in ["behaviour", "behaviour.kind"]:
            for behaviour in BEHAVIOURS:
                self.assertIn(f"  {behaviour} ", self.say("describe", name))

    def test_describe_finds_both_an_option_and_a_member_of_that_name(self):
        text = self.say("describe", "plan")
        self.assertIn("plan.kind\n", text)
        self.assertIn("plan (start)", text)

    def test_describe_a_family_and_its_members_and_options(self):
        text = self.say("describe", "potential")
        for part in ["potential: ", "  lennard_jones ",
                     "chosen by behaviour.attraction_repulsion.potential.kind\n"]:
            self.assertIn(part, text)
        key = "behaviour.attraction_repulsion.potential.expression"
        for end in ["", ".formula"]:
            self.assertEqual(self.say("describe", "potential.expression" + end),
                             self.say("describe", key + end))
        self.assertIn("claim_test.trend", self.say("describe", "claim_test.trend"))
        self.assertIn("  grid ", self.say("describe", "design"))

    def test_describe_a_study_and_what_stands_in_such_files(self):
        self.assertIn("[[group.factor]]", self.say("describe", "delta_theta"))
        self.assertIn("table.statistic\n", self.say("describe", "table"))
        option = self.say("describe", "comparison.resolve_percent")
        self.assertTrue(option.startswith("comparison.resolve_percent\n"), option)
        self.assertEqual(self.say("describe", "study.group.factor.values"),
                         self.say("describe", "factor.values"))
        for name, part in [("study", "study.replications\n"), ("group", "group.design.kind\n"),
                           ("factor", "factor.values\n"), ("level", "level.label\n"),
                           ("claims", "claims.correction\n"), ("claim", "claim.test.kind\n"),
                           ("statement", "statement.says\n"), ("cause", "cause.study\n"),
                           ("sensitivity", "sensitivity.convergence\n"),
                           ("attribution", "attribution.minus\n")]:
            self.assertIn(part, self.say("describe", name))

    def test_list_measures_shows_what_they_yield(self):
        text = self.say("list", "measures")
        for line in ["  energy ", "      energy_rate_w ", "      thrust_time_ratio_mean "]:
            self.assertIn("\n" + line, text)
        self.assertNotIn("energy_rate_w", self.say("list", "behaviour"))

    def test_describe_finds_options_by_their_last_names(self):
        for name, keys in (("replications", ["study.replications", "group.replications"]),
                           ("resolve_percent", ["comparison.resolve_percent"]),
                           ("seed", ["trial.seed", "study.seed"]), ("period_s", ["ping.period_s"]),
                           ("statistic", ["table.statistic"]), ("BEARING_SD_DEG", ["ping.bearing_sd_deg"])):
            text = self.say("describe", name)
            for key in keys:
                self.assertIn(f"{key}\n", text)

    def test_describe_names_the_new_key_for_one_that_was_renamed(self):
        for name in ("metrics", "table.metrics", "comparison.metrics"):
            self.assert_complains(self.shoal("describe", name), 2,
                                  ["metrics is now measures; write that"])
        self.assert_complains(self.shoal("describe", "claim.metric"), 2,
                              ["metric is now measure; write that"])

    def test_describe_lists_a_family_that_no_scenario_chooses(self):
        for family in ("design", "claim_test", "evaluation"):
            listed = self.say("list", family)
            for name in (family, family + ".kind", family + "s"):
                self.assertEqual(self.say("describe", name), listed)
        for name in ("scenario", "scenarios", "studies", "SETS"):
            self.assertEqual(self.say("describe", name), self.say("list", name.lower()))

    def test_describe_a_parameter_of_a_formula(self):
        key = "behaviour.attraction_repulsion.potential.expression.parameters"
        self.assertIn("takes a table of numbers; default none", self.say("describe", key))
        self.assertIn("takes any finite number", self.say("describe", key + ".a"))

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
        measures = self.run_trial("brief.toml")["measures"]
        listed = self.say("list", "measures")
        for name in measures:
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


if __name__ == "__main__":
    desk.main()
