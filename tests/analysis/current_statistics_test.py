"""The statistics that `shoal check` prints of current files, against an implementation in numpy."""

import os
import pathlib
import re
import sys
import unittest

import desk
from desk import Desk

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scenarios/tools"))
import drifting_window  # noqa: E402

SHARED = (pathlib.Path(os.environ.get("SHOAL_SHARED", ROOT.parent / "shared")) /
          "data/redsea_current.nc")


def library():
    return pathlib.Path(desk.SHOAL).parent.parent / "share/shoal/library"


class CurrentStatistics(Desk):
    def printed(self, *files):
        lines = self.shoal("check", *files).stdout.splitlines()
        rows = [re.split(r"\s{2,}", line.strip()) for line in lines]
        columns = {row[0]: row[2:] for row in rows if len(row) == 2 + len(files)}
        return [{name: float(columns[name][k]) for name in NAMES} for k in range(len(files))]

    def agree(self, printed, path):
        expected = drifting_window.statistics(drifting_window.read(path))
        self.assertEqual(set(expected), set(NAMES))
        for name, value in expected.items():
            self.assertAlmostEqual(printed[name] / value, 1.0, delta=1e-5, msg=f"{path}: {name}")

    def test_of_the_current_that_ships(self):
        made = library() / "currents/redsea_like.nc"
        (printed,) = self.printed("library:currents/redsea_like.nc")
        self.agree(printed, made)

    def test_of_two_files_side_by_side(self):
        if not SHARED.exists():
            self.skipTest(f"{SHARED} is not here; set SHOAL_SHARED to the folder of public data")
        made, reconstructed = self.printed("library:currents/redsea_like.nc", str(SHARED))
        self.agree(made, library() / "currents/redsea_like.nc")
        self.agree(reconstructed, SHARED)


NAMES = ["mean_u_m_s", "mean_v_m_s", "drift_m", "variance_u_m2_s2", "variance_v_m2_s2",
         "shear_300m_m_s", "decorrelation_length_m", "decorrelation_time_s"]


if __name__ == "__main__":
    desk.main()
