"""run.nc and series.nc, as their user opens them.

    python3 record_test.py SHOAL        (the program; needs xarray and netCDF4)
"""

import numpy as np
import xarray

import desk
from desk import Desk

SERIES = {
    "quality": "m", "quality_gap_m": "m", "empty_vehicles": "1", "energy_mean_wh": "W h", "energy_min_wh": "W h", "energy_max_wh": "W h",
    "centroid_path_m": "m", "efficiency_m_per_wh": "m W-1 h-1", "thrust_time_ratio_mean": "1",
    "thrust_time_ratio_min": "1", "thrust_time_ratio_max": "1",
    "thrust_distance_ratio_mean": "1", "thrust_distance_ratio_min": "1",
    "thrust_distance_ratio_max": "1", "rotation_disagreement_deg": "degree"}
RECORDED = {
    "x": "m", "y": "m", "depth": "m", "heading": "degree", "speed": "m s-1", "thrusting": "1",
    "target_x": "m", "target_y": "m", "target_reason": "1", "energy_propulsion": "W h",
    "energy_hotel": "W h", "energy_comms": "W h", "thrust_time": "s", "distance": "m",
    "thrust_distance": "m"}


class Record(Desk):
    def setUp(self):
        super().setUp()
        self.summary = self.run_trial(
            "redsea_square", "--set", "trial.duration_s=600", "--set",
            "trial.start=2014-12-01T00:30:00Z", "--set", "faults.node_loss={every_s=200,count=2}")
        # In the file positions are coordinates: here they are to be computed with.
        self.run_nc = xarray.open_dataset(self.desk / "out/run.nc").reset_coords(["x", "y", "depth"])
        self.addCleanup(self.run_nc.close)
        self.series = xarray.open_dataset(self.desk / "out/series.nc")
        self.addCleanup(self.series.close)

    def test_every_variable_has_its_unit_and_meaning_for_each_vehicle_and_time(self):
        self.assertEqual(self.run_nc.sizes["vehicle"], 20)
        self.assertEqual(self.run_nc.sizes["time"], 121)
        for name, unit in RECORDED.items():
            variable = self.run_nc[name]
            self.assertEqual(variable.dims, ("vehicle", "time"), name)
            self.assertEqual(variable.attrs["units"], unit, name)
            self.assertTrue(variable.attrs["long_name"], name)
        for name, unit in SERIES.items():
            variable = self.series[name]
            self.assertEqual(variable.dims, (name + "_time",))
            self.assertEqual(variable.attrs["units"], unit, name)
            self.assertTrue(variable.attrs["long_name"], name)
        self.assertEqual(set(self.run_nc.variables) - {"vehicle", "time"}, set(RECORDED))
        # A measure of your own may add its series.
        listed = self.shoal("list", "measures").stdout
        for name in set(self.series.data_vars) - set(SERIES):
            self.assertIn(f"  {name} ", listed)

    def test_a_series_of_nothing_is_left_out(self):
        self.run_trial("redsea_square", "--set", "trial.duration_s=60", "--set",
                       "quality.every_s=0", out="short")
        with xarray.open_dataset(self.desk / "short/series.nc") as series:
            self.assertEqual(set(self.series.data_vars) - set(series.data_vars),
                             {"quality", "quality_gap_m"})

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
        self.assertEqual(self.series["quality"].dims, ("quality_time",))
        self.assertEqual(self.series["quality_time"].values[1], np.datetime64("2014-12-01T00:30:30"))

    def test_lost_vehicles_are_missing_from_then_on(self):
        left = self.run_nc["x"].notnull().sum("vehicle").values
        self.assertEqual(sorted(set(left)), [18, 19, 20])
        self.assertTrue((np.diff(left) <= 0).all())
        self.assertEqual(self.summary["measures"]["lost_vehicles"], 2)

    def test_it_agrees_with_the_summary(self):
        measures = self.summary["measures"]
        end = self.run_nc.isel(time=-1)
        left = end.where(end["x"].notnull(), drop=True)
        total = left["energy_propulsion"] + left["energy_hotel"] + left["energy_comms"]
        for found, name in [(total.mean(), "energy_mean_wh"), (total.max(), "energy_max_wh"),
                            (left["energy_hotel"].mean(), "energy_hotel_mean_wh"),
                            (left["energy_comms"].mean(), "energy_comms_mean_wh"),
                            (left["thrust_time"].mean() / 600, "thrust_time_ratio_mean"),
                            (left["thrust_distance"].mean() / left["distance"].mean(),
                             "thrust_distance_ratio_mean")]:
            self.assertAlmostEqual(float(found) / measures[name], 1.0, 5, name)
        self.assertGreater(measures["energy_propulsion_mean_wh"], 0.0)

        quality = self.series["quality"].values
        self.assertEqual(quality[-1], measures["quality_final_m"])
        self.assertAlmostEqual(quality[8:].mean(), measures["quality_settled_m"], 9)

    def test_motion_and_energy_are_possible(self):
        kept = self.run_nc.where(self.run_nc["x"].isel(time=-1, drop=True).notnull(), drop=True)
        for name in ["energy_propulsion", "energy_hotel", "energy_comms", "thrust_time",
                     "distance", "thrust_distance"]:
            self.assertGreaterEqual(float(kept[name].diff("time").min()), 0.0, name)
        self.assertTrue((kept["thrust_distance"] <= kept["distance"] + 1e-3).all())
        step = np.hypot(np.diff(kept["x"].values), np.diff(kept["y"].values))
        self.assertLess(step.max(), 5 * 1.5)
        self.assertTrue(((kept["heading"] >= 0) & (kept["heading"] < 360)).all())


if __name__ == "__main__":
    desk.main()
