"""Single trials."""

from __future__ import annotations

import json
import operator
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, Callable, Mapping, NamedTuple

from . import _shoal

if TYPE_CHECKING:
    import xarray


class Run(NamedTuple):
    """What a trial leaves: `dataset, measures = shoal.run(...)`."""

    #: Every vehicle against time (dimensions vehicle and time, seconds since mission start), and
    #: every series with its own time; None if nothing was recorded.
    dataset: xarray.Dataset | None
    #: Measures by name, with the unit in the name; None where a measure has no value.
    measures: dict[str, float | None]


def plain(value: Any) -> Any:
    """Names and paths as text, mappings as dicts."""
    return dict(value) if isinstance(value, Mapping) else os.fspath(value)


def whole(value: Any, what: str) -> int:
    """An integer, also one of numpy's. Raises InputError for fractions, text and flags."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise _shoal.InputError(f"{what} is {value!r}; it takes an integer")
    return operator.index(value)


def name_of(value: Any, otherwise: str) -> str:
    return otherwise if isinstance(value, Mapping) else pathlib.Path(value).stem


def scenario(scenario: str | os.PathLike[str] | Mapping[str, Any],
             set: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The whole scenario as nested dicts, also what was not set. Change it and run it."""
    return _shoal.scenario(plain(scenario), dict(set or {}))


def current(scenario: str | os.PathLike[str] | Mapping[str, Any], time_s: float, x, y):
    """The current of a scenario: velocities (u, v) in m/s, east and north, at positions (m) of any shape,
    at a time since mission start; NaN where it is not known. Raises InputError."""
    return _shoal.current(plain(scenario), time_s, x, y)


def run(scenario: str | os.PathLike[str] | Mapping[str, Any],
        set: Mapping[str, Any] | None = None, seed: int | None = None, *, threads: int = 1,
        record: bool = True, out: str | os.PathLike[str] | None = None,
        report: bool = False,
        progress: Callable[[dict[str, float]], None] | None = None) -> Run:
    """Runs one trial.

    scenario: a name of the library, a file, or a dict. set: changes by dotted keys, over it. threads:
    for large swarms; the numbers do not depend on it. out: a folder for what `shoal run` writes
    (scenario.toml, run.nc, summary.json), and report.html if `report` is set. progress: called about
    twice a second with a dict of time_s (of the mission), duration_s and elapsed_s (of the clock).

    Other threads of Python go on meanwhile, and Ctrl-C ends the run. Raises InputError, SystemError, and what a cost of one's
    own raises.
    """
    changes = dict(set or {})
    if seed is not None:
        changes["trial.seed"] = whole(seed, "seed")
    with tempfile.TemporaryDirectory(prefix="shoal-") as temporary:
        folder = pathlib.Path(out if out is not None else temporary)
        summary = _shoal.run(plain(scenario), changes, name_of(scenario, "scenario"), str(folder),
                             threads, record, report, progress)
        return Run(_dataset(folder), json.loads(summary)["measures"])


def _dataset(folder: pathlib.Path) -> xarray.Dataset | None:
    if not (folder / "run.nc").exists():
        return None
    import xarray

    with _shoal.NetcdfLock():
        vehicles, series = (xarray.load_dataset(folder / name, decode_times=False)
                            for name in ("run.nc", "series.nc"))
    # Positions are coordinates in the file, as CF asks for; here they are numbers like others.
    return vehicles.reset_coords(["x", "y", "depth"]).merge(series)
