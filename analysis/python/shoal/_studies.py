"""Studies: many trials, their tables and claims."""

from __future__ import annotations

import io
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, Callable, Mapping

from . import _arguments, _netcdf, _shoal
from ._trials import name_of

if TYPE_CHECKING:
    import pandas
    import xarray


def folder_of(study: dict[str, Any] | str, out: str | os.PathLike[str] | None) -> str:
    """Where the trials of a study go, as `shoal sweep` has it."""
    if out is not None:
        return _arguments.path(out, "out")
    return str(pathlib.Path("out") / name_of(study, "study"))


def sweep(study: str | os.PathLike[str] | Mapping[str, Any],
          out: str | os.PathLike[str] | None = None, *, jobs: int | None = None,
          replications: int = 0, rerun_changed: bool = False, retry_failed: bool = False,
          progress: Callable[[dict[str, Any]], None] | None = None) -> pandas.DataFrame:
    """Runs the trials of a study that a folder does not hold yet, writes its tables into the folder, and
    returns all trials: see trials().

    study: a name of those that ship, a file, or a dict. jobs: trials at a time, 1 to 1024; default: all
    processors. replications: instead of those of the study, if above 0. progress: called a few times a second with
    a dict of counts. Interrupted, it goes on where it was when called again. Raises InputError and
    SystemError.
    """
    root = _arguments.source(study, "study")
    folder = folder_of(root, out)
    processors = min(os.cpu_count() or 1, _shoal.most_threads)
    jobs = _arguments.whole(processors if jobs is None else jobs, "jobs", 1, _shoal.most_threads)
    _shoal.sweep(root, folder, jobs, _arguments.whole(replications, "replications", 0),
                 _arguments.flag(rerun_changed, "rerun_changed"),
                 _arguments.flag(retry_failed, "retry_failed"), _arguments.function(progress, "progress"))
    write_tables(folder)
    return trials(folder)


def trials(folder: str | os.PathLike[str]) -> pandas.DataFrame:
    """The trials of a study, a row for each: group, factors, replication, seed, status, reason (why it
    failed), and every measure with its unit in its name."""
    import pandas

    return pandas.read_csv(io.StringIO(_shoal.trials_csv(_arguments.path(folder, "folder"))),
                           float_precision="round_trip")


def study_dataset(folder: str | os.PathLike[str], group: str | None = None) -> xarray.Dataset:
    """Measures and stored series of a study, with its factors as dimensions. group: of the study, where
    it has named ones."""
    with tempfile.TemporaryDirectory(prefix="shoal-") as temporary:
        file = os.path.join(temporary, "study.nc")
        _shoal.export_netcdf(_arguments.path(folder, "folder"), file)
        return _netcdf.load(file, group)


def tables(folder: str | os.PathLike[str]) -> dict[str, _shoal.Table]:
    """The tables of a study, by name, from what is stored."""
    return {table.name: table for table in _swept(folder).tables()}


def write_tables(folder: str | os.PathLike[str]) -> None:
    """Writes them, and that of the claims, into its folder `tables`, as LaTeX, CSV and Markdown."""
    _swept(folder).write_tables()


def claims(folder: str | os.PathLike[str]) -> pandas.DataFrame:
    """The claims of a study tested on what is stored: a row for each contrast, in each column of
    verdicts (a level of the factor that the file of claims compares side by side)."""
    import pandas

    columns = ["statement", "section", "claim", "column", "statement_verdict", "verdict", "contrast",
               "contrast_verdict", "claimed", "n", "trials", "never_reached", "estimate", "low", "high",
               "p_holds", "p_fails", "corrected_p"]
    return pandas.DataFrame(_swept(folder).claims(), columns=columns)


def study_report(folder: str | os.PathLike[str]) -> pathlib.Path:
    """Writes report.html into the folder of a study, and returns its path."""
    _swept(folder).write_report()
    return pathlib.Path(folder) / "report.html"


def _swept(folder: str | os.PathLike[str]) -> _shoal.SweptStudy:
    return _shoal.SweptStudy(_arguments.path(folder, "folder"))
