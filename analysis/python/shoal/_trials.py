"""Single trials."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, Callable, Mapping, NamedTuple

from . import _arguments, _netcdf, _shoal

if TYPE_CHECKING:
    import xarray


class Run(NamedTuple):
    """What a trial leaves: `dataset, measures = shoal.run(...)`."""

    #: Every vehicle against time (dimensions vehicle and time, seconds since mission start), and
    #: every series with its own time; None if nothing was recorded.
    dataset: xarray.Dataset | None
    #: Measures by name, with the unit in the name; None where a measure has no value.
    measures: dict[str, float | None]


def name_of(source: dict[str, Any] | str, otherwise: str) -> str:
    return otherwise if isinstance(source, dict) else pathlib.Path(source).stem


def scenario(scenario: str | os.PathLike[str] | Mapping[str, Any],
             set: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The whole scenario as nested dicts, also what was not set. Change it and run it."""
    return _shoal.scenario(_arguments.source(scenario, "scenario"), _arguments.table(set, "set"))


def current(scenario: str | os.PathLike[str] | Mapping[str, Any], time_s: float, x, y):
    """The current of a scenario: velocities (u, v) in m/s, east and north, at positions (m) of any shape,
    at a time since mission start; NaN where it is not known. Raises InputError."""
    return _shoal.current(_arguments.source(scenario, "scenario"), time_s, x, y)


def run(scenario: str | os.PathLike[str] | Mapping[str, Any],
        set: Mapping[str, Any] | None = None, seed: int | None = None, *, threads: int = 1,
        record: bool = True, out: str | os.PathLike[str] | None = None,
        report: bool = False,
        progress: Callable[[dict[str, float]], None] | None = None) -> Run:
    """Runs one trial.

    scenario: a name of the library, a file, or a dict. set: changes by dotted keys, over it. threads:
    1 to 1024, for large swarms; the numbers do not depend on it. out: a folder for what `shoal run`
    writes (scenario.toml, run.nc, summary.json), and report.html if `report` is set. progress: called
    about twice a second with a dict of time_s (of the mission), duration_s and elapsed_s (of the clock).

    Other threads of Python go on meanwhile, and Ctrl-C ends the run. Raises InputError, SystemError, and what a cost of one's
    own raises.
    """
    root = _arguments.source(scenario, "scenario")
    changes = _arguments.table(set, "set")
    if seed is not None:
        changes["trial.seed"] = _arguments.whole(seed, "seed")
    threads = _arguments.whole(threads, "threads", 1, _shoal.most_threads)
    record, report = _arguments.flag(record, "record"), _arguments.flag(report, "report")
    progress = _arguments.function(progress, "progress")
    if report and out is None:
        raise _shoal.InputError("report is True, and out is None; give the folder that report.html is for")
    with tempfile.TemporaryDirectory(prefix="shoal-") as temporary:
        folder = temporary if out is None else _arguments.path(out, "out")
        summary = _shoal.run(root, changes, name_of(root, "scenario"), folder, threads, record, report,
                             progress)
        return Run(_dataset(pathlib.Path(folder)), json.loads(summary)["measures"])


def _dataset(folder: pathlib.Path) -> xarray.Dataset | None:
    if not (folder / "run.nc").exists():
        return None
    vehicles, series = (_netcdf.load(folder / name) for name in ("run.nc", "series.nc"))
    # Positions are coordinates in the file, as CF asks for; here they are numbers like others.
    return vehicles.reset_coords(["x", "y", "depth"]).merge(series)
