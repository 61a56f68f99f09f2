"""Every figure by what is drawn: no number outside its axes and no text outside its page, nothing
over something else, no two curves that look the same.

    python3 figures_drawn_test.py SHOAL
"""

import math
import pathlib
import subprocess
import sys
import types
import unittest
import warnings

import desk
import matplotlib
import matplotlib.pyplot as plt
import numpy
from figures_test import FIGURES, REPEL

matplotlib.use("Agg")
TOP = pathlib.Path(__file__).resolve().parents[2] / "analysis"
sys.path.insert(0, str(TOP / "reporting" / "figures"))

import made_tables  # noqa: E402
import names  # noqa: E402
import odd_tables  # noqa: E402
from drawn_checks import faults, texts_of  # noqa: E402

# More vehicles than there are colours.
LOSING = ("--set", "trial.duration_s=300", "--set", "plan.square.rows=2", "--set",
          "plan.square.columns=4", "--set", "faults.node_loss.every_s=50", "--set",
          "faults.node_loss.count=2")
RUNS = {**{name: (name, "--set", "trial.duration_s=40", *(REPEL if "potential" in shown else ()))
           for name, shown in FIGURES.items()},
        "quickstart": ("redsea_square",),
        "vehicles that are lost": ("construction_square", *LOSING),
        "a single instant": ("construction_square", "--set", "trial.duration_s=10")}


class FiguresDrawn(desk.Desk):
    def setUp(self):
        super().setUp()
        package = str(pathlib.Path(desk.SHOAL).parents[1] / "python")
        sys.path.insert(1, package)
        self.addCleanup(sys.path.remove, package)

    def assert_fine(self, draw, widths=(1, 2), more=lambda figure: []):
        import catalogue
        import style
        figure = None
        for columns in widths:
            with self.subTest(columns=columns), style.page(columns), warnings.catch_warnings():
                warnings.simplefilter("error")
                figure = catalogue.drawn(draw)
                if figure is not None:
                    self.assertEqual([*faults(figure), *more(figure)], [])
        return figure is not None

    def succeed(self, *arguments):
        done = self.shoal(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_figures_of_runs(self):
        import catalogue
        for number, (run, arguments) in enumerate(RUNS.items()):
            self.succeed("run", *arguments, "--no-report", "--out", str(number))
            made = set()
            for name, draw in catalogue.figures_of(self.desk / str(number)).items():
                with self.subTest(run=run, figure=name):
                    made |= {name} if self.assert_fine(draw) else set()
            usual = {"trajectories", "speeds", "energy", "quality"}
            self.assertLessEqual(FIGURES.get(run, usual), made)

    def test_trajectories_say_that_colours_repeat(self):
        import over_ground
        for vehicles, says in ((7, False), (8, True)):
            x = numpy.arange(vehicles) * 10.0 + numpy.zeros((3, 1))
            run = types.SimpleNamespace(
                waypoint=None, obstacles=[], by_vehicle={"x": x, "y": x + [[0], [5], [9]]}.get,
                ends=lambda x=x: (x[-1], x[-1] + 9, x[-1] < 0))

            def wrongly_said(figure, says=says):
                said = any("colours repeat after 7" in t.get_text() for t in texts_of(figure))
                return [f"{said}, rather than {says}"] if said != says else []
            self.assertTrue(self.assert_fine(lambda run=run: over_ground.trajectories(run),
                                             more=wrongly_said))

    def test_figures_of_studies_that_ship(self):
        import of_study
        seen = set()
        for name in made_tables.STUDIES:
            for table, request in self.tables_of(name):
                if (form := form_of(table, request)) in seen:
                    continue
                seen.add(form)
                with self.subTest(study=name, table=table.name):
                    known = any(not math.isnan(number) for column in table.numbers
                                for number in table.column(column))
                    drawn = self.assert_fine(lambda: of_study.figure_of(table, request),
                                             more=unsaid_difference(request))
                    self.assertEqual(drawn, known)
        self.assertGreater(len(seen), 30)

    def tables_of(self, name):
        text = made_tables.shortened((TOP / "studies" / f"{name}.toml").read_text())
        self.write(f"{name}.toml", text)
        yield from self.stored_tables(name, ("table", "comparison"), "--shard", "1/50")
        if made_tables.needs_trials(text):
            yield from self.stored_tables(name, ("sensitivity", "attribution"))

    def stored_tables(self, name, kinds, *which):
        from stored_study import StoredStudy
        out = "-".join([name, *kinds])
        self.succeed("sweep", f"{name}.toml", "--replications", "2", *which, "--out", out)
        self.succeed("tables", out)
        study = StoredStudy(self.desk / out)
        for table in study.tables.values():
            request = study.requests[table.name]
            if request["of"] in kinds:
                if "table" in kinds:
                    made_tables.fill(table, request)
                yield table, request

    def test_numbers_of_every_kind_in_tables_of_every_form(self):
        import of_study
        from stored_study import StudyTable
        for form in odd_tables.forms():
            for kind, value in odd_tables.VALUES.items():
                if form not in odd_tables.FOR_ALL and kind not in odd_tables.OF_ALL:
                    continue
                with self.subTest(form=form, numbers=kind):
                    rows, request = odd_tables.forms()[form]
                    table = StudyTable("odd", "", rows)
                    made_tables.fill(table, request, value)
                    self.assertTrue(self.assert_fine(lambda: of_study.figure_of(table, request),
                                                     (1, 2) if kind == "steady" else (1,),
                                                     unsaid_difference(request)))

    def test_numbers_that_are_missing_or_only_bounds(self):
        import of_study
        from stored_study import StudyTable
        for rows, says in (
                ([("a", "300", "3", "0", "0"), ("b", "20", "3", "0", "3"), ("c", "", "0", "3", "")],
                 {"c (trials failed)", "open: not all trials reached it"}),
                ([("a", "20", "3", "0", "3"), ("b", "30", "3", "0", "3")], set()),
                ([(str(k), "20", "3", "0", "3") if k < 5 else (str(k), "", "0", "0", "")
                  for k in range(6)], {"level 5 (trials not run)"})):
            rows = [{"level": level, "time_s": value, "time_s_n": n, "time_s_failed": failed,
                     "time_s_not_run": "0" if value or failed != "0" else "3",
                     "time_s_reached": reached} for level, value, n, failed, reached in rows]
            table = StudyTable("t", "", rows)
            request = {"measures": ["time_s"], "factors": {}}
            with self.subTest(says):
                self.assertTrue(self.assert_fine(
                    lambda: of_study.figure_of(table, request),
                    more=lambda figure: {text.get_text() for legend in figure.legends
                                         for text in legend.get_texts()} ^ says))

    def test_one_curve_of_differences_says_what_is_compared(self):
        import of_study
        from stored_study import StudyTable
        rows = [{"measure": "energy mean (Wh)", "period_s": period, "behaviour": "rigid_registration",
                 "difference": value, "difference_n": "2"}
                for period, value in (("5", "1"), ("15", "-2"), ("30", "2"))]
        table = StudyTable("t", "", rows)
        request = {"of": "comparison", "factor": "behaviour", "reference": "pairwise_referencing",
                   "measures": ["energy_mean_wh"], "factors": {}}

        def unsaid(figure):
            said = {text.get_text() for text in texts_of(figure)}
            return {"Behaviour", "rigid registration"} - said
        self.assertTrue(self.assert_fine(lambda: of_study.figure_of(table, request), more=unsaid))

    def test_a_difference_that_not_all_trials_reached(self):
        from stored_study import StudyTable
        for remark, reached in (("Reached by 3 of 3, and by 2 of 3 of the others.", False),
                                ("Reached by 3 of 3, and by 3 of 3 of the others.", True), ("", True)):
            row = {"d": "1", "d_n": "3", "d_remarks": remark}
            self.assertEqual(StudyTable("t", "", [row]).all_reached("d"), [reached])

    def test_more_than_a_figure_can_show(self):
        import of_study
        import panels
        import style
        from stored_study import StudyTable
        rows = [{"a": str(a), "b": f"b{b}", "c": f"c{c}", "energy_mean_wh": "1",
                 "energy_mean_wh_n": "2"} for a in range(3) for b in range(8) for c in range(32)]
        for own, says in ((rows, "has 256 curves"), (rows[:256], "has 256 rows")):
            table = StudyTable("much", "", own)
            with style.page(1), self.assertRaisesRegex(panels.TooMuch, says):
                of_study.figure_of(table, {"measures": ["energy_mean_wh"]})
            self.write("study/study.toml",
                       '[[table]]\nname = "much"\nmeasures = ["energy_mean_wh"]\n')
            self.write("study/tables/much.csv", "\n".join(",".join(row) for row in [
                list(table.rows[0]), *(row.values() for row in table.rows)]) + "\n")
            done = subprocess.run([sys.executable, "-B", TOP / "reporting" / "figures", "study"], cwd=self.desk,
                                  text=True, capture_output=True, check=False)
            self.assert_complains(done, 2, ["much " + says, "with where in the request of much"])

    def test_performance_profiles(self):
        import panels
        import profiles
        for solvers in (1, 7, 8):
            rows = [{"family": family, "measure": measure, "solver": f"nlopt.solver_{k}",
                     "factor": str(2.0 ** octave), "share": str(min(1.0, 0.1 * octave * (k + 1)))}
                    for family in ("pair_potential", "registration")
                    for measure in ("seconds", "evaluations")
                    for k in range(solvers) for octave in range(15)]
            if solvers > 7:
                with self.assertRaisesRegex(panels.TooMuch, "8 solvers.* shoal solve --solvers"):
                    profiles.profiles(rows)
            else:
                self.assertTrue(self.assert_fine(lambda own=rows: profiles.profiles(own)))

    def test_progress_curves(self):
        import progress
        rows = [{"family": family, "measure": measure, "solver": f"nlopt.solver_{k}",
                 "effort": str(2.0 ** octave), "left": str(0.1 ** (octave * (k + 1))),
                 "left_low": "0", "left_high": str(min(1.0, 10 * 0.1 ** (octave * (k + 1))))}
                for family in ("solver", "registration") for measure in ("seconds", "evaluations")
                for k in range(7) for octave in range(15)]
        self.assertTrue(self.assert_fine(lambda: progress.progress(rows)))

    def test_names_as_words(self):
        for name, said in (("delta_theta_deg_deg", "delta theta (deg)"),
                           ("heading_noise_deg_s_deg_s", "heading noise (deg/s)"),
                           ("damping_per_s_1_s", "damping (1/s)"), ("speed_m_s", "speed (m/s)"),
                           ("efficiency_m_per_wh", "efficiency (m/Wh)"),
                           ("time_to_quality_20m_s", "time to quality 20 m (s)"),
                           ("quality", "quality (m)"), ("nees_per_state", "NEES per state"),
                           ("arrived_vehicles", "arrived vehicles")):
            self.assertEqual(names.words(name), said)


class Checks(unittest.TestCase):
    """They see what they are for."""

    def assert_seen(self, part, spoil):
        """Of axes that nothing is wrong with until they are spoilt."""
        with matplotlib.rc_context({"figure.constrained_layout.use": True}):
            figure, axes = plt.subplots()
            self.addCleanup(plt.close, figure)
            axes.set_xlabel("Time (s)")
            axes.plot([0, 1], [100, 200], label="one")
            for spoilt in (False, True):
                if spoilt:
                    spoil(axes)
                figure.draw_without_rendering()
                found = faults(figure)
                self.assertEqual(any(part in fault for fault in found), spoilt, found)

    def test_numbers_outside_their_axes(self):
        self.assert_seen("numbers reach", lambda axes: axes.set_ylim(0, 1))
        self.assert_seen("numbers take", lambda axes: axes.set_ylim(90, 9000))
        self.assert_seen("are empty", lambda axes: axes.lines[0].remove())

    def test_texts_that_cannot_be_read(self):
        self.assert_seen("is cut off", lambda axes: axes.set_ylabel("long " * 60))
        self.assert_seen("overlap", lambda axes: axes.figure.text(0.5, 0.02, "Time again"))
        self.assert_seen("touches another",
                         lambda axes: axes.set_xticks([0, 0.05, 1], ["1000"] * 3))
        self.assert_seen("a name of the program", lambda axes: axes.set_ylabel("energy_mean"))
        self.assert_seen("its unit twice", lambda axes: axes.set_ylabel("Delta theta deg (deg)"))
        self.assert_seen("no axis says", lambda axes: axes.set_xlabel(""))

    def test_legends_that_do_not_help(self):
        def pale(axes):
            axes.plot([0, 1], [100, 200], "*", color="white", label="white")
            axes.legend()

        self.assert_seen("contrast", pale)
        self.assert_seen("hides", lambda axes: axes.legend())
        self.assert_seen("covers another",
                         lambda axes: [axes.figure.legend(axes.lines, [a]) for a in "ab"])
        self.assert_seen("have 1 looks",
                         lambda axes: axes.plot([0, 1], [100, 150], color="C0", label="two"))
        self.assert_seen("more than can be followed", lambda axes: [
            axes.plot([0, 1], [100, k], label=f"{k}") for k in range(101, 110)])
        self.assert_seen("same twice",
                         lambda axes: axes.figure.legend([*axes.lines] * 2, ["one", "one"]))


def form_of(table, request):
    """Figures of two tables with the same form differ in their numbers and the words of an axis."""
    named = ("of", "columns", "against", "statistic")
    return (tuple(table.labels), len(table.numbers), len(table.rows),
            len(request.get("measures", [])), *(str(request.get(name)) for name in named))


def unsaid_difference(request):
    """A check that a comparison says of what its numbers are differences, and shows where there is
    none."""
    def check(figure):
        if request.get("of") != "comparison":
            return
        said = [" ".join(text.get_text().split()) for text in texts_of(figure)]
        if not any("difference from" in text for text in said):
            yield "no axis says that it shows differences"
        for axes in figure.axes:
            if not any(0 in line.get_xdata() or 0 in line.get_ydata() for line in axes.lines if len(
                    line.get_xdata()) == 2 and line.get_transform() != axes.transData):
                yield "nothing shows where there is no difference"
    return check


if __name__ == "__main__":
    desk.main()
