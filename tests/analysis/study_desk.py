"""What the tests of studies share: a small study, and looks at what a sweep of it leaves."""

import sqlite3

from desk import Desk

STUDY = """title = "two behaviours"
scenario = "construction_square"
replications = 3
set = { trial.duration_s = 300 }

[[factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "assignment_registration"]

[[factor]]
key = "behaviour.assignment_registration.matching.sampled.delta_theta_deg"
values = [10, 45]
only = { behaviour = "assignment_registration" }

[[table]]
name = "energy"
rows = ["behaviour", "delta_theta_deg"]
measures = ["energy_mean_wh", "quality_final_m"]

[[table]]
name = "against_time"
columns = ["behaviour"]
pool = ["delta_theta_deg"]
series = ["quality"]
every = 60
"""
SHORT = STUDY.replace("= 300", "= 90")  # where it matters only that trials were run
TRIALS = 9  # rigid registration has no delta theta to vary

# The content of a manifest.json, and what is said of it.
DAMAGED_MANIFESTS = [
    (b"", "the file is empty"),
    (b"{", "no valid JSON"),
    (b'{"sweeps": [{"began": "\xff"}]}', "no valid JSON"),
    (b"[]", "lists no sweeps"),
    (b"{}", "lists no sweeps"),
    (b'{"sweeps": 5}', "sweeps is no list"),
    (b'{"sweeps": [7]}', "sweeps holds an entry that is no object"),
    (b'{"sweeps": [{"began": 7}]}', "sweeps holds an entry without the time"),
    (b'{"sweeps": [], "merges": {}}', "merges is no list"),
]


class StudyDesk(Desk):
    """A desk with study.toml on it."""

    def setUp(self):
        super().setUp()
        self.write("study.toml", STUDY)

    def sweep(self, *arguments, study="study.toml", out="out"):
        done = self.shoal("sweep", study, "--out", out, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def tables(self, out="out"):
        return {f.name: f.read_bytes() for f in (self.desk / out / "tables").iterdir()}

    def rows(self, columns, out="out"):
        store = sqlite3.connect(self.desk / out / "trials.sqlite")
        try:
            return store.execute(f"SELECT {columns} FROM trial ORDER BY trial_key").fetchall()
        finally:
            store.close()
