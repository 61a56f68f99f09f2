"""Which figures there are of what a folder or file holds."""

import csv

import against_time
import fitting
import of_models
import of_study
import over_ground
import profiles
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
        return {place.stem: lambda rows=profile_rows(place): profiles.profiles(rows)}
    if (place / "study.toml").is_file():
        study = StoredStudy(place)
        return {name: lambda table=table: of_study.figure_of(table, study.request_of(table))
                for name, table in study.tables.items()}
    run = RecordedRun(place)
    if not of_models.shoal:
        print("without shoal's Python package there are no figures " + ", ".join(NEEDS_PACKAGE))
    return {name: lambda draw=draw: draw(run) for name, draw in FIGURES.items()
            if of_models.shoal or name not in NEEDS_PACKAGE}


def profile_rows(file):
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    if not rows or not {"family", "measure", "solver", "factor", "share"} <= set(rows[0]):
        raise NoRun(f"{file} holds no performance profiles; shoal solve --profiles writes them")
    return rows


def drawn(draw):
    """The figure with all its texts in place, or nothing if there is nothing to show."""
    figure = draw()
    return figure if figure is None else fitting.fit(figure)
