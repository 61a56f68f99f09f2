"""What the tests of the `shoal` program share: a folder to work in, and small scenarios."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

SHOAL = ""

SMALL = """[trial]
duration_s = 60
[plan]
square = { rows = 2, columns = 2, separation_m = 300 }
"""
FILE_PLAN = '[trial]\nduration_s = 60\n[plan]\nkind = "file"\nfile.path = "plan.csv"\n'
REPELLED = ('behaviour.kind = "attraction_repulsion"\n' + SMALL +
            "[behaviour.attraction_repulsion]\n")


class Desk(unittest.TestCase):
    """A folder of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.desk = pathlib.Path(folder.name)
        self.write("ok.toml", SMALL)

    def write(self, name, content):
        file = self.desk / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())

    def files(self):
        return {str(f.relative_to(self.desk)) for f in self.desk.rglob("*") if f.is_file()}

    def shoal(self, *arguments, **settings):
        if arguments[:1] == ("sweep",):  # they take longer than most sweeps
            arguments += ("--no-figures",)
        return subprocess.run([SHOAL, *map(str, arguments)], cwd=self.desk, capture_output=True,
                              text=True, timeout=60, check=False, **settings)

    def sh(self, line):
        """A line of a shell, in which $SHOAL is the program."""
        return subprocess.run(["bash", "-c", line], cwd=self.desk, capture_output=True, text=True,
                              timeout=60, check=False, env={**os.environ, "SHOAL": SHOAL})

    def run_trial(self, *arguments, out="out"):
        done = self.shoal("run", *arguments, "--out", out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads((self.desk / out / "summary.json").read_text())

    def assert_complains(self, done, status, parts):
        """One line `shoal: ...` on stderr that says these things in this order."""
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertRegex(done.stderr, r"\Ashoal: [^\n]+\n\Z")
        rest = done.stderr
        for part in parts:
            self.assertIn(part, rest, done.stderr)
            rest = rest[rest.index(part) + len(part):]


def main():
    global SHOAL
    SHOAL = os.path.abspath(sys.argv.pop(1))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    unittest.main()
