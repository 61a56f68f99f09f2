"""What a folder of `shoal run` holds: scenario.toml, run.nc and series.nc."""

import contextlib
import math
import tomllib

import netCDF4
import numpy


class NoRun(Exception):
    """The folder is none that `shoal run` wrote, or is damaged."""


MOST_NUMBERS = 1 << 28  # of a variable; shoal reads no more at once either
FARTHEST = 1e12


class RecordedRun:
    """A trial. Metres east and north, seconds; vehicles are numbered in the order of the plan."""

    def __init__(self, folder):
        for name in ("scenario.toml", "run.nc", "series.nc"):
            if not (folder / name).is_file():
                raise NoRun(f"{folder} has no {name}; name a folder that shoal run wrote, "
                            "with trial.record_every_s above 0")
        self.scenario = tomllib.loads((folder / "scenario.toml").read_text(encoding="utf-8"))
        self._file = folder / "run.nc"
        with opened(self._file) as record:
            self._vehicles = vehicles_of(record.variables, self._file)
            self.obstacles = outlines_of(record.groups, self._file)
        self.time_s = self._vehicles.pop("time")
        with opened(folder / "series.nc") as record:
            self._series = series_of(record.variables, folder / "series.nc")

    def by_vehicle(self, name):
        """A recorded number: rows are instants, columns vehicles."""
        if name not in self._vehicles:
            raise NoRun(f"{self._file} has no {name} by vehicle and time; it is none that shoal run "
                        "wrote, or damaged")
        return self._vehicles[name].T

    def series(self, name):
        """(seconds, numbers) of a measure against time, or nothing if it has no value."""
        seconds, numbers = self._series.get(name, ((), ()))
        return (seconds, numbers) if numpy.isfinite(numbers).any() else None

    def ends(self):
        """(east, north, whether it was lost) of each vehicle, where it was recorded last."""
        x, y = self.by_vehicle("x"), self.by_vehicle("y")
        known = numpy.isfinite(x) & numpy.isfinite(y)
        last = len(x) - 1 - numpy.argmax(known[::-1], axis=0)
        vehicles = numpy.arange(x.shape[1])
        return x[last, vehicles], y[last, vehicles], ~known[-1]

    @property
    def waypoint(self):
        """(east, north), or nothing if there is none."""
        place = self.scenario.get("waypoint")
        return (place["x_m"], place["y_m"]) if place else None

    def arrived(self):
        """Of each vehicle, whether a recorded instant finds it at the waypoint."""
        x, y = self.waypoint
        away = numpy.hypot(self.by_vehicle("x") - x, self.by_vehicle("y") - y)
        return (away <= self.scenario["waypoint"]["radius_m"]).any(axis=0)


@contextlib.contextmanager
def opened(file):
    """By a name of the system: the library would change one with backslashes."""
    with open(file, "rb") as content, netCDF4.Dataset(f"/proc/self/fd/{content.fileno()}") as record:
        yield record


def vehicles_of(variables, file):
    """name -> its numbers by vehicle and instant, and those of time; refuses what shoal never
    wrote."""
    if not is_along(variables, "time", ("time",)) or not is_along(variables, "x",
                                                                  ("vehicle", "time")):
        raise NoRun(f"{file} is none that shoal run wrote; name the folder of a run")
    for name, what in (("time", "instant"), ("x", "vehicle")):
        if variables[name].size == 0:
            raise NoRun(f"{file} holds no {what}; run the trial again")
    names = ["time", *(name for name in variables if is_along(variables, name, ("vehicle", "time")))]
    return {name: possible(name, variables[name], file) for name in names}


def outlines_of(groups, file):
    """The edge of each obstacle as a polygon: rows of east and north."""
    if "obstacles" not in groups:
        return []
    variables = groups["obstacles"].variables
    names = ("obstacle", "x", "y")
    if not all(is_along(variables, name, ("corner",)) for name in names):
        raise NoRun(f"{file} has obstacles without corners, as in no run of shoal; run the trial again")
    number, x, y = (possible(name, variables[name], file) for name in names)
    return [numpy.column_stack([x, y])[number == each] for each in numpy.unique(number)]


def series_of(variables, file):
    """name -> (seconds, numbers)."""
    return {name: tuple(numbers_of(variables[each], file) for each in (f"{name}_time", name))
            for name in variables
            if is_along(variables, name, (f"{name}_time",))
            and is_along(variables, f"{name}_time", (f"{name}_time",))}


def is_along(variables, name, dimensions):
    """Whether there are numbers of that name, of these dimensions."""
    variable = variables.get(name)
    return (variable is not None and isinstance(variable.dtype, numpy.dtype)
            and variable.dtype.kind in "fiu" and variable.dimensions == dimensions)


def numbers_of(variable, file):
    if variable.size > MOST_NUMBERS:
        raise NoRun(f"{file}: {variable.name} has more than {MOST_NUMBERS} numbers; that is more "
                    "than shoal reads at once")
    return numpy.ma.filled(numpy.ma.asarray(variable[:], dtype=float), math.nan)


def possible(name, variable, file):
    """Its numbers, which are such as shoal writes."""
    values = numbers_of(variable, file)
    fine = numpy.abs(values) <= FARTHEST
    if name != "time":
        fine |= numpy.isnan(values)
    if name == "target_reason":
        codes = numpy.ravel(getattr(variable, "flag_values", ()))
        fine &= numpy.isnan(values) | numpy.isin(values, codes)
    if not fine.all():
        raise NoRun(f"{file}: {name} is {values[~fine][0]:g} somewhere, as in no run of shoal; run "
                    "the trial again")
    return values
