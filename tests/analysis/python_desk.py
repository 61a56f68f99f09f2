"""What tests of the Python package share."""

import signal
import subprocess
import sys

from desk import Desk


def thesis(r, s):
    return s**3 / (2 * r**2) + r - 3 * s


class Until:
    """Progress that ends a run after so many seconds."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __call__(self, now):
        if now["elapsed_s"] > self.seconds:
            raise StopIteration


class PythonDesk(Desk):
    def assert_interrupted(self, file):
        """Ctrl-C ends a program that says that it is on its way, and would go on for minutes."""
        with subprocess.Popen([sys.executable, file], cwd=self.desk, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
            try:
                self.assertEqual(running.stdout.readline(), "on its way\n")
                running.send_signal(signal.SIGINT)
                _, complaint = running.communicate(timeout=120)
            finally:
                running.kill()
        self.assertIn("KeyboardInterrupt", complaint)
