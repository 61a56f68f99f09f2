"""run.nc and series.nc are what CF-1.8 asks for, and each of the rules finds a file that breaks it.

    /usr/bin/python3 cf_rules_test.py SHOAL        (needs netCDF4)
"""

import cf_rules
import desk
import netCDF4
import numpy
from desk import Desk


def small(path, change=lambda file: None):
    """Two trajectories of three instants; `change` breaks them."""
    with netCDF4.Dataset(path, "w") as file:
        file.Conventions = "CF-1.8"
        file.featureType = "trajectory"
        for name, size in (("vehicle", 2), ("length", 1), ("time", 3)):
            file.createDimension(name, size)
        vehicle = file.createVariable("vehicle", "S1", ("vehicle", "length"))
        vehicle.setncatts({"cf_role": "trajectory_id", "long_name": "vehicle"})
        vehicle[:] = numpy.array([[b"a"], [b"b"]])
        time = file.createVariable("time", "f8", ("time",))
        time.setncatts({"units": "seconds since 2014-12-01T00:00:00Z", "axis": "T",
                        "standard_name": "time"})
        time[:] = [0, 1, 2]
        for name, more in (("x", {"axis": "X"}), ("y", {"axis": "Y"}),
                           ("depth", {"axis": "Z", "positive": "down", "standard_name": "depth"}),
                           ("speed", {"coordinates": "time x y depth vehicle"})):
            made = file.createVariable(name, "f4", ("vehicle", "time"), fill_value=numpy.nan)
            made.setncatts({"units": "m s-1" if name == "speed" else "m", "long_name": name, **more})
            made[:] = [[1, 2, 3], [4, 5, 6]]
        change(file)


def lost(file):
    file["x"][1, 2] = file["y"][1, 2] = numpy.nan


BROKEN = {
    "2.3: the name": lambda f: f.createDimension("3d", 1),
    "2.6.1": lambda f: setattr(f, "Conventions", "none"),
    "3.1: speed has no": lambda f: f["speed"].delncattr("units"),
    "3.1: speed is in": lambda f: f["speed"].setncattr("units", "knots"),
    "3.2": lambda f: f["x"].delncattr("long_name"),
    "3.3": lambda f: f["depth"].setncattr("units", "s"),
    "3.5: speed has flag": lambda f: f["speed"].setncattr("flag_meanings", "slow fast"),
    "3.5: flag_values": lambda f: f["speed"].setncatts({"flag_meanings": "a b", "flag_values": [0, 1]}),
    "4.3": lambda f: f["depth"].delncattr("positive"),
    "4.4": lambda f: f["time"].setncattr("units", "s"),
    "5: the coordinate": lambda f: f["time"].__setitem__(slice(None), [0, 2, 1]),
    "5: speed has": lambda f: f["speed"].setncattr("coordinates", "time x y z"),
    "9.1": lambda f: f["y"].delncattr("axis"),
    "9.4: the featureType": lambda f: setattr(f, "featureType", "tracks"),
    "9.4: series is no part": lambda f: f.createVariable("series", "f8", ("time",)).setncatts(
        {"units": "m", "long_name": "of all"}),
    "9.5: not just one": lambda f: f["vehicle"].delncattr("cf_role"),
    "9.5: two trajectories": lambda f: f["vehicle"].__setitem__((1, 0), b"a"),
    "9.5: the coordinates": lambda f: f["speed"].delncattr("coordinates"),
    "9.6": lost,
}


class CfRules(Desk):
    def found(self, path):
        with netCDF4.Dataset(self.desk / path) as file:
            return list(cf_rules.complaints(file))

    def test_every_rule_finds_what_breaks_it(self):
        small(self.desk / "whole.nc")
        self.assertEqual(self.found("whole.nc"), [])
        for complaint, change in BROKEN.items():
            with self.subTest(complaint):
                small(self.desk / "broken.nc", change)
                self.assertTrue(any(each.startswith(complaint) for each in self.found("broken.nc")),
                                self.found("broken.nc"))

    def test_a_run_keeps_them(self):
        for name, *sets in [("redsea_square", "faults.node_loss={every_s=40,count=2}"),
                            ("potentials_clutter",), ("estimation",)]:
            with self.subTest(name):
                words = [word for each in ("trial.duration_s=120", *sets) for word in ("--set", each)]
                self.run_trial(name, *words)
                self.assertEqual(self.found("out/run.nc") + self.found("out/series.nc"), [])


if __name__ == "__main__":
    desk.main()
