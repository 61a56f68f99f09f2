"""Sweeps on many machines, by dask.distributed.

    from dask.distributed import Client
    import shoal.distributed

    frame = shoal.distributed.sweep("thesis_chapter5", Client("scheduler:8786"))

From the command line: `shoal sweep thesis_chapter5 --dask scheduler:8786`.

A task is a few trials. What travels to a worker is their resolved scenarios as text (some 3 kB each),
what comes back are their measures and the series that tables need. Workers write nothing; the process
that sweeps stores each trial as it arrives, in the same store and with the same numbers as `shoal sweep`.
Workers need the same shoal, and the files that scenarios name under the same paths. A worker that dies
loses the trials it was running, which others then run; one that joins late gets its share.
"""

from __future__ import annotations

import argparse
import contextlib
import logging
import os
import pathlib
import subprocess
import sys
import time
import uuid
from typing import TYPE_CHECKING, Any, Callable, Mapping

from . import _arguments, _members, _potentials, _shoal
from ._studies import folder_of, trials

if TYPE_CHECKING:
    import pandas
    from distributed import Client

# Tasks under way for each thread of the workers: enough that none waits for the next, few enough that
# a late worker finds some left.
TASKS_A_THREAD = 4
AGAIN = "; what was run is stored: sweep again to go on"


def sweep(study: str | os.PathLike[str] | Mapping[str, Any], client: Client,
          out: str | os.PathLike[str] | None = None, *, batch: int = 1, replications: int = 0,
          rerun_changed: bool = False, retry_failed: bool = False,
          progress: Callable[[dict[str, Any]], None] | None = None) -> pandas.DataFrame:
    """Runs on the workers of a client the trials of a study that a folder does not hold yet, writes its
    tables into the folder, and returns all trials: see shoal.trials().

    batch: trials of a task; more than one pays for trials shorter than some 50 ms. The other arguments
    are those of shoal.sweep(). Interrupted or cut off, it goes on where it was when called again.
    Raises InputError, and SystemError also if the scheduler is lost or workers keep dying.
    """
    batch = _arguments.whole(batch, "batch", 1)
    progress = _arguments.function(progress, "progress")
    open_sweep, folder = opened(study, client, out, replications, rerun_changed, retry_failed)
    run(open_sweep, client, batch, progress)
    _shoal.SweptStudy(folder).write_tables()
    return trials(folder)


def opened(study: str | os.PathLike[str] | Mapping[str, Any], client: Client,
           out: str | os.PathLike[str] | None, replications: int, rerun_changed: bool,
           retry_failed: bool) -> tuple[_shoal.OpenSweep, str]:
    """The sweep of a study, and its folder."""
    root = _arguments.source(study, "study")
    folder = folder_of(root, out)
    return _shoal.OpenSweep(root, folder, _arguments.whole(replications, "replications", 0),
                            _arguments.flag(rerun_changed, "rerun_changed"),
                            _arguments.flag(retry_failed, "retry_failed"), _Threads(client).now()), folder


def run(open_sweep: _shoal.OpenSweep, client: Client, batch: int,
        progress: Callable[[dict[str, Any]], None] | None) -> None:
    """Has the trials of an open sweep run, and stores them."""
    from distributed import as_completed
    from distributed.scheduler import KilledWorker

    threads = _Threads(client)
    name = f"shoal-{uuid.uuid4().hex[:8]}"
    first = 0
    batches: dict[str, range] = {}

    def submit():
        nonlocal first
        indices = range(first, min(first + batch, len(open_sweep)))
        first = indices.stop
        # Not pure: the answer of another task may not stand for it.
        future = client.submit(answers, [open_sweep.request(i) for i in indices], _own_code(),
                               key=f"{name}-{indices.start}", pure=False)
        batches[future.key] = indices
        return future

    done = as_completed(with_results=True)
    try:
        while first < len(open_sweep) or batches:
            while first < len(open_sweep) and len(batches) < TASKS_A_THREAD * threads.now():
                done.add(submit())
            try:
                future, found = next(done)  # raises what a task raised
            except ModuleNotFoundError as error:
                raise _shoal.SystemError(_without_package(client, error) + AGAIN) from error
            except KilledWorker as error:
                raise _shoal.SystemError(f"one worker after the other dies of a trial ({error})"
                                         + AGAIN) from error
            if future.status != "finished":  # all are cancelled with the scheduler
                raise _shoal.SystemError("the scheduler of dask is lost" + AGAIN)
            for index, answer in zip(batches.pop(future.key), found):
                open_sweep.store(index, answer)
            if progress is not None:
                progress(open_sweep.progress())
    finally:
        # A scheduler that is lost knows of no task any more, and does not answer.
        with contextlib.suppress(OSError):
            for future in list(done.futures):
                future.cancel()
    open_sweep.end()


def _without_package(client: Client, error: ModuleNotFoundError) -> str:
    # A lambda travels as code; a function of this module would need the module.
    can_import = lambda name: __import__("importlib.util").util.find_spec(name) is not None  # noqa: E731
    name = error.name or "shoal"
    lacking = [worker for worker, can in client.run(can_import, name).items() if not can]
    where = f"the worker{'s' * (len(lacking) > 1)} {' and '.join(sorted(lacking))}" if lacking else "a worker"
    package = pathlib.Path(__file__).resolve().parent.parent
    return f"{where} cannot import {name}; start workers with PYTHONPATH={package}, or install the package there"


def _own_code() -> tuple[dict, dict]:
    """What this process was given, and a worker needs: classes, and functions of potentials."""
    return dict(_members.KNOWN), dict(_potentials.KNOWN)


def answers(requests: list[str], own_code: tuple[dict, dict] = ({}, {})) -> list[str]:
    """What a worker does."""
    classes, functions = own_code
    _members.learn(classes)
    _potentials.learn(functions)
    return [_shoal.answer(request) for request in requests]


class _Threads:
    """How many threads the workers have, asked for once a second: asking takes as long as a task."""

    def __init__(self, client: Client):
        self._client, self._asked, self._known = client, -1.0, 1

    def now(self) -> int:
        if self._asked < 0 or time.monotonic() - self._asked > 1.0:
            workers = self._client.scheduler_info()["workers"].values()
            self._known = max(1, sum(worker["nthreads"] for worker in workers))
            self._asked = time.monotonic()
        return self._known


def _main() -> int:
    parser = argparse.ArgumentParser(prog="shoal sweep --dask")
    parser.add_argument("study")
    parser.add_argument("address")
    parser.add_argument("--out")
    parser.add_argument("--replications", type=int, default=0)
    parser.add_argument("--batch", type=int, default=1)
    parser.add_argument("--rerun-changed", action="store_true")
    parser.add_argument("--retry-failed", action="store_true")
    parser.add_argument("--figures", help="the program that draws them")
    wanted = parser.parse_args()
    try:
        import distributed
    except ImportError:
        return _complain("sweeps on many machines need dask.distributed; install python3-distributed", 1)
    logging.disable()  # of dask's many parts: what matters comes back as an error
    try:
        client = distributed.Client(wanted.address, timeout=20)
    except (OSError, ValueError, TimeoutError) as error:
        return _complain(f"no scheduler of dask answers at {wanted.address} ({error}); start "
                         "dask-scheduler there", 1)
    shown = sys.stderr.isatty()
    if not client.scheduler_info()["workers"]:
        print(f"shoal: no worker has joined {wanted.address} yet; waiting for dask-worker {wanted.address}",
              file=sys.stderr, flush=True)

    try:
        with client:
            open_sweep, folder = opened(wanted.study, client, wanted.out, wanted.replications,
                                        wanted.rerun_changed, wanted.retry_failed)

            def line(_: dict[str, Any]) -> None:
                print(f"\r{open_sweep.progress_text()}\033[K", end="", file=sys.stderr, flush=True)

            run(open_sweep, client, wanted.batch, line if shown else None)
        if shown:
            print("\r\033[K", end="", file=sys.stderr)
        print(*open_sweep.summary(), sep="\n")
        study = _shoal.SweptStudy(folder)
        study.write_tables()
        drawn = wanted.figures is not None and subprocess.run(
            [sys.executable, "-B", wanted.figures, folder], stdout=subprocess.DEVNULL).returncode == 0
        study.write_report()
    except _shoal.InputError as error:
        return _complain(error, 2)
    except _shoal.SystemError as error:
        return _complain(error, 1)
    except KeyboardInterrupt:
        return _complain("interrupted" + AGAIN, 1)
    print(f"written: {folder}/tables, {folder}/report.html")
    if drawn:
        print(f"written: {folder}/figures, each as .pdf and .svg")
    return 0


def _complain(what: Any, status: int) -> int:
    print(f"shoal: {what}", file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(_main())
