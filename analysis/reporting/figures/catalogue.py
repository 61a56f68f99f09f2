"""Which figures there are of what a folder or file holds."""

import csv

import against_time
import fitting
import of_models
import of_study
import over_ground
import profiles
import progress
from recorded_run import NoRun, RecordedRun
from stored_study import StoredStudy

# Of a run, in the order in which they are made: name -> how, or nothing where a run has none of it.
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
NEEDS_PACKAGE = [name for name, draw in FIGURES.items() if draw.__module__ == "of_models"]


def figures_of(place):
    """name -> what draws it."""
    if place.suffix == ".csv" and place.is_file():
        return dict(figures_of_solvers(place))
    if (place / "study.toml").is_file():
        study = StoredStudy(place)
        return {name: lambda table=table: of_study.figure_of(table, study.request_of(table))
                for name, table in study.tables.items()}
    run = RecordedRun(place)
    if not of_models.shoal:
        print("without shoal's Python package there are no figures " + ", ".join(NEEDS_PACKAGE))
    return {name: lambda draw=draw: draw(run) for name, draw in FIGURES.items()
            if of_models.shoal or name not in NEEDS_PACKAGE}


def figures_of_solvers(file):
    """What shoal solve --profiles wrote: the profiles, and if they stand beside, progress curves."""
    beside = file.with_name(f"{file.stem}_progress{file.suffix}")
    for each in (file, beside):
        if each != file and not each.is_file():
            continue
        with open(each, newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        if each != file and not rows:  # closed forms only
            continue
        columns = set(rows[0]) if rows else set()
        if {"family", "measure", "solver", "factor", "share"} <= columns:
            yield each.stem, lambda rows=rows: profiles.profiles(rows)
        elif {"family", "measure", "solver", "effort", "left", "left_low", "left_high"} <= columns:
            yield each.stem, lambda rows=rows: progress.progress(rows)
        else:
            raise NoRun(f"{each} holds neither performance profiles nor progress curves; "
                        "shoal solve --profiles writes both")


def drawn(draw):
    """The figure with all its texts in place, or nothing if there is nothing to show."""
    figure = draw()
    return figure if figure is None else fitting.fit(figure)
