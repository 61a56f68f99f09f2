"""What a folder of `shoal run` holds: scenario.toml, run.nc and series.nc."""

import math
import tomllib

import netCDF4
import numpy


class NoRun(Exception):
    """The folder is none that `shoal run` wrote, or is damaged."""


class RecordedRun:
    """A trial. Metres east and north, seconds; vehicles are numbered in the order of the plan."""

    def __init__(self, folder):
        for name in ("scenario.toml", "run.nc", "series.nc"):
            if not (folder / name).is_file():
                raise NoRun(f"{folder} has no {name}; name a folder that shoal run wrote, "
                            "with trial.record_every_s above 0")
        try:
            self.scenario = tomllib.loads((folder / "scenario.toml").read_text())
            self._values, self._dimensions = {}, {}
            for name in ("run.nc", "series.nc"):
                with netCDF4.Dataset(folder / name) as record:
                    self._take(record.variables)
        except (tomllib.TOMLDecodeError, OSError, RuntimeError) as error:
            raise NoRun(f"{folder} is damaged: {error}") from error
        self.time_s = self._values["time"]

    def _take(self, variables):
        for name, variable in variables.items():
            self._dimensions[name] = variable.dimensions
            if variable.dtype.kind in "fiu":
                values = variable[:]
                masked = hasattr(values, "filled")
                self._values[name] = values.filled(math.nan) if masked else values

    def by_vehicle(self, name):
        """A recorded number: rows are instants, columns vehicles."""
        values = numpy.asarray(self._values[name], dtype=float)
        return values if self._dimensions[name][0] == "time" else values.T

    def series(self, name):
        """(seconds, numbers) of a measure against time, or nothing if it has no value."""
        if name not in self._values or not numpy.isfinite(self._values[name]).any():
            return None
        return self._values[self._dimensions[name][0]], self._values[name]

    def ends(self):
        """(east, north, whether it was lost) of each vehicle, where it was recorded last."""
        x, y = self.by_vehicle("x"), self.by_vehicle("y")
        known = numpy.isfinite(x) & numpy.isfinite(y)
        last = len(x) - 1 - numpy.argmax(known[::-1], axis=0)
        vehicles = numpy.arange(x.shape[1])
        return x[last, vehicles], y[last, vehicles], ~known[-1]

    @property
    def obstacles(self):
        """(shape, its options) of each."""
        return [(o["shape"]["kind"], o["shape"][o["shape"]["kind"]])
                for o in self.scenario.get("obstacle", [])]

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
