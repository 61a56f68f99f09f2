"""Figures for papers, of what `shoal run`, `shoal sweep` or `shoal solve --profiles` wrote."""

import argparse
import csv
import pathlib
import sys


def complain(what, status):
    print(f"shoal: {what}", file=sys.stderr)
    sys.exit(status)


try:
    import matplotlib
    import netCDF4  # noqa: F401
except ImportError as missing:
    complain(f"figures need Python's {missing.name}; install python3-{missing.name.lower()}", 1)
matplotlib.use("Agg")  # no screen

import against_time  # noqa: E402
import of_models  # noqa: E402
import of_study  # noqa: E402
import over_ground  # noqa: E402
import style  # noqa: E402
from recorded_run import NoRun, RecordedRun  # noqa: E402
from stored_study import StoredStudy  # noqa: E402

# Of a run, in the order in which they are made: name -> how, or nothing where the run has none of it.
FIGURES = {
    "trajectories": over_ground.trajectories,
    "basin": over_ground.basin,
    "speeds": against_time.speeds,
    "energy": against_time.energy,
    "energy_by_distance": against_time.energy_by_distance,
    "efficiency": against_time.efficiency,
    "quality": against_time.quality,
    "thrust": against_time.thrust,
    "passage": against_time.passage,
    "current": of_models.current,
    "potential": of_models.potential,
    "cost_surface": of_models.cost_surface,
    "filter_lag": of_models.filter_lag,
}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        complain(message + "; see shoal figures --help", 2)


def of_folder(folder):
    """name -> how, of what stands there."""
    if folder.suffix == ".csv" and folder.is_file():
        with open(folder, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        if not rows or not {"family", "measure", "solver", "factor", "share"} <= set(rows[0]):
            raise NoRun(f"{folder} holds no performance profiles; shoal solve --profiles writes them")
        return {folder.stem: lambda: of_study.profiles(rows)}
    if (folder / "study.toml").is_file():
        study = StoredStudy(folder)
        return {name: lambda table=table: of_study.figure_of(table, study.requests.get(table.name, {}))
                for name, table in study.tables.items()}
    run = RecordedRun(folder)
    known = {name: draw for name, draw in FIGURES.items()
             if of_models.shoal or draw.__module__ != "of_models"}
    if len(known) < len(FIGURES):
        print("without shoal's Python package there are no figures "
              + ", ".join(name for name in FIGURES if name not in known))
    return {name: lambda draw=draw: draw(run) for name, draw in known.items()}


def main():
    parser = Parser(prog="shoal figures", description=__doc__)
    parser.add_argument("what", type=pathlib.Path,
                        help="folder of shoal run or shoal sweep, or a file of performance profiles")
    parser.add_argument("--only", nargs="+", metavar="FIGURE",
                        help="some of them: tables of a study, or, of a run, " + ", ".join(FIGURES))
    parser.add_argument("--columns", type=int, choices=(1, 2), default=1,
                        help="width, in columns of a paper (default: 1)")
    parser.add_argument("--out", type=pathlib.Path, help="default: figures in or beside it")
    options = parser.parse_args()
    what = options.what
    out = options.out or (what if what.is_dir() else what.parent) / "figures"
    made = []
    try:
        known = of_folder(what)
        for name in options.only or []:
            if name not in known:
                complain(f"{what} has no figure \"{name}\"; there are {', '.join(known)}", 2)
        for name in options.only or known:
            with style.page(options.columns):
                figure = known[name]()
                if figure is not None:
                    made += style.save(figure, out, name)
    except NoRun as error:
        complain(error, 2)
    except OSError as error:
        complain(f"cannot write {error.filename}: {error.strerror}", 1)
    if not made:
        complain(f"{what} has nothing that these figures show", 2)
    print("written: " + ", ".join(map(str, made)))


if __name__ == "__main__":
    main()
