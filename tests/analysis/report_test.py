"""shoal report as its user sees it: the page holds what was recorded, and bad input is refused with its reason.

    python3 report_test.py SHOAL
"""

import base64
import json
import pathlib
import re

import desk
import netCDF4
import numpy
from desk import Desk

DATA = re.compile(r'<script type="application/json" id="data">(.*?)</script>', re.DOTALL)


def page_data(page):
    return json.loads(DATA.search(page).group(1))


def levels(packed):
    raw = numpy.frombuffer(base64.b64decode(packed["data"]), "<u2")
    return numpy.where(raw == 65535, numpy.nan, packed["offset"] + packed["scale"] * raw)


def steps(packed):
    rows = len(packed["first"])
    raw = numpy.frombuffer(base64.b64decode(packed["data"]), "<i2").reshape(rows, -1).astype(float)
    ended = numpy.logical_or.accumulate(raw == -32768, axis=1)
    numbers = (numpy.array(packed["first"], float)[:, None]
               + packed["unit"] * numpy.cumsum(numpy.where(ended, 0, raw), axis=1))
    return numpy.where(ended, numpy.nan, numbers)


def floats(text):
    return numpy.frombuffer(base64.b64decode(text), "<f4")


def copy_changed(whole, file, change):
    """A record written anew, since netCDF changes none that was written without an order of creation."""
    with netCDF4.Dataset(whole) as old, netCDF4.Dataset(file, "w") as new:
        new.setncatts({name: old.getncattr(name) for name in old.ncattrs()})
        for name, dimension in old.dimensions.items():
            new.createDimension(name, len(dimension))
        for name, variable in old.variables.items():
            attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
            copy = new.createVariable(name, variable.dtype, variable.dimensions,
                                      fill_value=attributes.pop("_FillValue", None))
            copy.setncatts(attributes)
            for each in (variable, copy):
                each.set_auto_maskandscale(False)
                each.set_auto_chartostring(False)
            copy[...] = variable[...]
        change(new)


class Report(Desk):
    def page(self, folder="out"):
        return (self.desk / folder / "report.html").read_text()

    def test_the_page_holds_what_was_recorded(self):
        self.run_trial("redsea_square", "--set", "trial.duration_s=600", "--set",
                       "faults.node_loss={every_s=200,count=2}")
        data = page_data(self.page())
        with netCDF4.Dataset(self.desk / "out" / "run.nc") as record:
            values = {name: numpy.ma.filled(record[name][:].astype(float), numpy.nan)
                      for name in ("time", "x", "y", "heading", "speed", "energy_propulsion",
                                   "energy_hotel", "energy_comms", "thrusting")}
        with netCDF4.Dataset(self.desk / "out" / "series.nc") as record:
            values["quality"] = record["quality"][:].filled(numpy.nan)
        numpy.testing.assert_allclose(floats(data["time_s"]), values["time"])
        shape = values["x"].shape
        for axis in "xy":
            packed = data["tracks"][axis]
            numpy.testing.assert_allclose(steps(packed), values[axis], atol=0.51 * packed["unit"])
            self.assertLessEqual(packed["unit"], 0.01)
        self.assertTrue(numpy.isnan(values["x"]).any())  # the lost are gone, on the page as well
        energy = sum(values[f"energy_{part}"] for part in ("propulsion", "hotel", "comms"))
        for name, wanted in (("heading", values["heading"]), ("speed", values["speed"]),
                             ("energy", energy)):
            packed = data["tracks"]["levels"][name]
            numpy.testing.assert_allclose(levels(packed).reshape(shape), wanted,
                                          atol=0.51 * packed["scale"] + 1e-6)
        mode = numpy.frombuffer(base64.b64decode(data["tracks"]["mode"]), "u1").reshape(shape)
        numpy.testing.assert_array_equal(mode & 1, numpy.nan_to_num(values["thrusting"]))
        series = next(each for each in data["series"] if each["name"] == "quality")
        numpy.testing.assert_allclose(floats(series["values"]), values["quality"], rtol=1e-6)

    def test_measures_and_scenario_are_those_of_the_run(self):
        summary = self.run_trial("ok.toml")
        data = page_data(self.page())
        self.assertEqual({row["name"]: row["value"] for row in data["measures"]},
                         summary["measures"])
        self.assertTrue(all(row["meaning"] for row in data["measures"]))
        self.assertEqual(data["scenario"], (self.desk / "out" / "scenario.toml").read_text())

    def test_twenty_vehicles_for_five_hours_are_below_3_mb(self):
        self.run_trial("redsea_square")
        self.assertLess((self.desk / "out" / "report.html").stat().st_size, 3e6)
        self.assertEqual(page_data(self.page())["notes"], [])

    def test_says_that_it_leaves_instants_out(self):
        done = self.shoal("run", "redsea_square", "--set", "trial.record_every_s=1", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        note = "The playback shows one in 5 recorded instants"
        self.assertIn(note, done.stdout)
        data = page_data(self.page())
        self.assertIn(note, data["notes"][0])
        times = floats(data["time_s"])
        self.assertEqual((times[0], times[1], times[-1]), (0, 5, 18000))

    def test_again_from_what_is_stored(self):
        self.run_trial("potentials_clutter", "--set", "trial.duration_s=60")
        first = self.page()
        (self.desk / "out" / "report.html").unlink()
        done = self.shoal("report", "out")
        self.assertEqual((done.returncode, done.stdout), (0, "written: out/report.html\n"))
        self.assertEqual(self.page(), first)

    def test_none_if_it_is_not_wanted(self):
        self.run_trial("ok.toml", "--no-report")
        self.assertFalse((self.desk / "out" / "report.html").exists())

    def test_obstacles_have_their_shapes(self):
        self.run_trial("potentials_clutter", "--set", "trial.duration_s=5")
        outlines = page_data(self.page())["obstacles"]
        self.assertEqual(len(outlines), 4)
        for outline in outlines:
            x, y = numpy.array(outline).T
            area = 0.5 * numpy.sum(x * numpy.roll(y, -1) - numpy.roll(x, -1) * y)
            self.assertGreater(area, 0)
        with netCDF4.Dataset(self.desk / "out" / "run.nc") as record:
            obstacles = record["obstacles"]
            self.assertEqual(obstacles["obstacle"][:].tolist(),
                             [k for k, each in enumerate(outlines, 1) for _ in each])
            self.assertLess(abs(obstacles["x"][:] - numpy.concatenate(outlines)[:, 0]).max(), 0.06)

    def test_vehicles_have_the_colours_of_the_figures(self):
        top = pathlib.Path(__file__).parents[2] / "analysis" / "reporting"
        lists = [re.findall(r'"(#\w{6}|ink)"', re.search(r"COLOURS = \[(.*?)\]", file.read_text()).group(1))
                 for file in (top / "figures" / "style.py", top / "page" / "layers.js")]
        self.assertEqual(len(lists[0]), 7)
        # Black is the ink of the page, which is light on dark.
        self.assertEqual([colour.replace("#000000", "ink") for colour in lists[0]], lists[1])

    def test_names_cannot_break_the_page(self):
        self.write("a<script>&.toml", desk.SMALL)
        self.run_trial("a<script>&.toml")
        page = self.page()
        self.assertEqual(page_data(page)["title"], "a<script>&")
        self.assertFalse("a<script>&" in page)

    def test_asks_for_no_other_file(self):
        self.run_trial("ok.toml")
        page = self.page()
        self.assertEqual(re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="(?!data:)', page), [])
        self.assertTrue("Leon Sorokin" in page)  # the licence of the charts goes with them

    def test_without_a_record_there_is_no_playback_and_the_page_says_so(self):
        done = self.shoal("run", "ok.toml", "--set", "trial.record_every_s=0", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("There is no playback", done.stdout)
        self.assertIn("There is no playback", page_data(self.page())["notes"][0])

    def test_a_current_that_has_gone_is_reported(self):
        self.run_trial("redsea_square", "--set", "trial.duration_s=60")
        file = self.desk / "out" / "scenario.toml"
        file.write_text(re.sub(r'"[^"]*redsea_like.nc"', '"gone.nc"', file.read_text()))
        done = self.shoal("report", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("The current is not shown: ", done.stdout)
        self.assertIn("gone.nc", done.stdout)

    def test_says_what_is_wrong(self):
        self.assert_complains(self.shoal("report", "nowhere"), 2,
                              ["nowhere holds neither a run nor a study; name a folder"])
        self.run_trial("ok.toml")
        out = self.desk / "out"
        summary = (out / "summary.json").read_text()
        (out / "summary.json").write_text(summary[:50])
        self.assert_complains(self.shoal("report", "out"), 2, ["out/summary.json", "damaged"])
        (out / "summary.json").unlink()
        self.assert_complains(self.shoal("report", "out"), 2, ["there is no out/summary.json"])
        (out / "summary.json").write_text(summary)
        (out / "run.nc").write_bytes(b"no netCDF")
        self.assert_complains(self.shoal("report", "out"), 2, ["out/run.nc"])

    def test_a_summary_of_an_earlier_version_says_what_has_changed(self):
        self.run_trial("ok.toml")
        summary = self.desk / "out/summary.json"
        summary.write_text(summary.read_text().replace('"measures"', '"metrics"'))
        self.assert_complains(self.shoal("report", "out"), 2,
                              ["out/summary.json: metrics is now measures; write that"])

    def test_a_record_as_of_no_run_is_refused(self):
        self.run_trial("ok.toml")
        file = self.desk / "out/run.nc"
        whole = self.desk / "whole.nc"
        file.rename(whole)

        def set_all(name, value):
            return lambda record: record[name].__setitem__(slice(None), value)

        copy_changed(whole, file, lambda record: None)
        self.assertEqual(self.shoal("report", "out").returncode, 0)
        for change, said in [
                (set_all("time", 0.0), "time is 0 and then 0, as in no run of shoal"),
                (set_all("thrusting", 17.0), "thrusting is 17 somewhere"),
                (set_all("thrusting", 0.5), "thrusting is 0.5 somewhere"),
                (lambda record: record["time"].setncattr("units", "hours since 2014-12-01"),
                 'time is in "hours since 2014-12-01", and not in seconds')]:
            with self.subTest(said):
                copy_changed(whole, file, change)
                self.assert_complains(self.shoal("report", "out"), 2, ["out/run.nc: ", said])

    def test_a_run_of_another_plan_is_refused(self):
        self.run_trial("ok.toml")
        self.run_trial("ok.toml", "--set", "plan.square.rows=3", out="other")
        (self.desk / "other" / "run.nc").rename(self.desk / "out" / "run.nc")
        self.assert_complains(self.shoal("report", "out"), 2, ["6 vehicles", "4", "different runs"])


if __name__ == "__main__":
    desk.main()
