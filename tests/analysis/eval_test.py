"""shoal eval as its user sees it: reference files, columns in any order, and bad input.

    python3 eval_test.py SHOAL
"""

import csv
import math
import pathlib

import desk
from desk import Desk

DATA = pathlib.Path(__file__).parent.parent / "data"
REFERENCES = {"obstacle": "obstacle_geometry.csv", "clamp": "force_clamp.csv",
              "field": "potential_field.csv", "nps_auv": "nps_auv_derivatives.csv"}
PLACE = "shape,cx,cy,a_or_r,b,psi,px,py\n"


class Eval(Desk):
    def evaluated(self, model, file):
        done = self.shoal("eval", model, file)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return list(csv.DictReader(done.stdout.splitlines()))

    def assert_refused(self, model, content, parts):
        self.write("in.csv", content)
        done = self.shoal("eval", model, "in.csv")
        self.assert_complains(done, 2, parts)
        self.assertEqual(done.stdout, "")

    def test_agrees_with_the_reference_files(self):
        for model, name in REFERENCES.items():
            with open(DATA / name, encoding="utf-8") as file:
                expected = list(csv.DictReader(file))
            got = self.evaluated(model, DATA / name)
            self.assertEqual(len(got), len(expected))
            compared = 0
            for line, (row, other) in enumerate(zip(got, expected), 2):
                for column, number in row.items():
                    if math.isnan(float(other[column])):
                        continue  # not unique
                    wanted = float(other[column])
                    self.assertAlmostEqual(float(number), wanted, delta=1e-9 if model != "nps_auv"
                                           else 1e-10 * abs(wanted), msg=f"{name}:{line}: {column}")
                    compared += 1
            self.assertGreater(compared, 200)

    def test_finds_columns_by_name_whatever_else_there_is(self):
        for model, name in REFERENCES.items():
            with open(DATA / name, encoding="utf-8") as file:
                rows = list(csv.reader(file))
            turned = [",".join(["note", *reversed(row)]) for row in rows]
            self.write("turned.csv", "\n".join(turned) + "\n")
            self.assertEqual(self.evaluated(model, DATA / name), self.evaluated(model, "turned.csv"))

    def test_prints_one_of_the_answers_where_several_would_do(self):
        self.write("in.csv", PLACE + "circle,1,2,3,3,0,1,2\nellipse,0,0,5,4,0,0,0\n"
                   "rectangle,0,0,8,4,0,7,3\nrect,0,0,8,4,0,8,4\n")
        rows = self.evaluated("obstacle", "in.csv")
        self.assertEqual([list(map(float, row.values())) for row in rows],
                         [[-3, 1, 0, 4, 2, 0], [-4, 0, 1, 0, 4, 0], [-1, 1, 0, 8, 3, 0],
                          [0, 1, 0, 8, 4, 0]])

    def test_prints_numbers_that_read_back(self):
        self.write("in.csv", PLACE + "circle,0,0,1,,,0.1,0.2\n")
        row = self.evaluated("obstacle", "in.csv")[0]
        self.assertEqual(float(row["nx"]), 0.1 / math.hypot(0.1, 0.2))

    def test_says_what_is_wrong_and_in_which_line(self):
        self.assert_refused("obstacle", PLACE.replace("psi,", ""),
                            ["in.csv:1: ", '"psi" is missing', "names shape, cx, cy"])
        self.assert_refused("obstacle", "", ["in.csv: ", "empty", "shape, cx"])
        self.assert_refused("obstacle", PLACE, ["in.csv: ", "no rows"])
        circle = PLACE + "circle,0,0,1,1,0,9,9\n"
        for row, parts in (("circle,0,0,0,1,0,9,9", ["a_or_r is 0", "above 0"]),
                           ("rectangle,0,0,1,-2,0,9,9", ["b is -2", "above 0"]),
                           ("ellipse,0,0,nan,2,0,9,9", ['a_or_r is "nan"', "finite number"]),
                           ("ellipse,0,0,1,2,,9,9", ["psi is empty"]),
                           ("elipse,0,0,1,2,0,9,9", ['"elipse"', 'did you mean "ellipse"?']),
                           ("circle,0,0,1,1,0,9", ["7 fields", "8"]),
                           ("circle,0,0,1,1,0,9,1e999", ['py is "1e999"'])):
            self.assert_refused("obstacle", circle + row + "\n", ["in.csv:3: ", *parts])
        clamp = "f_par,f_perp,u_prev,r_prev,T,u_max,du_max,r_max,dr_max\n"
        self.assert_refused("clamp", clamp + "0,0,1,0,0,2,.05,.08,.04\n", ["in.csv:2: ", "T is 0"])
        self.assert_refused("clamp", clamp + "0,0,1,0,.5,2,-1,.08,.04\n", ["in.csv:2: ", "du_max"])
        self.assert_refused("field", "kind\ncircle\n", ["in.csv:1: ", '"cx" is missing'])

    def test_refuses_files_and_models_that_are_none(self):
        self.assert_complains(self.shoal("eval", "clamp", "none.csv"), 2, ["cannot open none.csv"])
        self.assert_complains(self.shoal("eval", "clamp", "."), 2, [". is a directory"])
        self.assert_complains(self.shoal("eval", "clmp", "none.csv"), 2,
                              ['no model "clmp"', 'did you mean "clamp"?'])

    def test_its_help_names_the_columns_of_every_model(self):
        said = self.shoal("eval", "--help").stdout
        for model, name in REFERENCES.items():
            self.assertIn(f"  {model}: ", said)
            for column in self.evaluated(model, DATA / name)[0]:
                self.assertRegex(said, rf"\n      {column} +\S")
        for column in ("a_or_r", "f_par", "wx"):
            self.assertRegex(said, rf"\n      {column} +\S")


if __name__ == "__main__":
    desk.main()
