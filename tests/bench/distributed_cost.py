"""What a sweep on many machines sends, stores and costs, measured on this one.

    PYTHONPATH=build/ci/python python3 distributed_cost.py [STUDY]
"""

import pathlib
import sys
import tempfile
import time

import shoal
from shoal import _shoal

study = sys.argv[1] if len(sys.argv) > 1 else "thesis_chapter5"
with tempfile.TemporaryDirectory() as folder:
    sweep = _shoal.OpenSweep(study, folder, 1, False, False, 1)
    began = time.monotonic()
    requests = [sweep.request(i) for i in range(len(sweep))]
    asking = time.monotonic() - began
    began = time.monotonic()
    answers = [_shoal.answer(request) for request in requests]
    running = time.monotonic() - began
    began = time.monotonic()
    for i, answer in enumerate(answers):
        sweep.store(i, answer)
    storing = time.monotonic() - began
    count = len(requests)
    size = (pathlib.Path(folder) / "trials.sqlite").stat().st_size
    print(f"{study}: {count} trials on one thread, {running / count:.2f} s each")
    print(f"  sent to a worker    {sum(map(len, requests)) / count / 1e3:8.1f} kB a trial, "
          f"{1e3 * asking / count:.2f} ms to write")
    print(f"  sent back           {sum(map(len, answers)) / count / 1e3:8.1f} kB a trial")
    print(f"  stored              {size / count / 1e3:8.1f} kB a trial, "
          f"{1e3 * storing / count:.2f} ms to store")
