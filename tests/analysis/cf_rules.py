"""Rules of CF-1.8 for files of trajectories and of series: those of its conformance document for what
such files hold, and of chapter 9 with appendix H.4. Each complaint names its section."""

import re

import numpy

NAME = re.compile(r"^[A-Za-z][A-Za-z0-9_]*$")
# As UDUNITS spells them.
UNITS = re.compile(r"^(1|m|s|m s-1|W|W h|W h h-1|m W-1 h-1|m h-1|degree|degree s-1|N|seconds since \d{4}-\d\d-\d\dT"
                   r"\d\d:\d\d:\d\dZ)$")
STANDARD_NAMES = {"time": "seconds since", "depth": "m"}
FEATURES = {"point", "timeSeries", "trajectory", "profile", "timeSeriesProfile", "trajectoryProfile"}


def complaints(file):
    """Of an open netCDF4.Dataset."""
    yield from of_names(file)
    for variable in file.variables.values():
        yield from of_units(variable)
        yield from of_flags(variable)
        yield from of_axes(variable)
        yield from of_coordinates(file, variable)
    if "CF-1.8" not in getattr(file, "Conventions", ""):
        yield "2.6.1: Conventions does not say CF-1.8"
    if hasattr(file, "featureType"):
        yield from of_features(file)


def of_names(file):
    names = [*file.variables, *file.dimensions]
    for name in names:
        if not NAME.match(name):
            yield f"2.3: the name {name}"
    if len({name.lower() for name in file.variables}) < len(file.variables):
        yield "2.3: two variables whose names differ by case"
    for variable in file.variables.values():
        if len(set(variable.dimensions)) < len(variable.dimensions):
            yield f"2.4: {variable.name} has a dimension twice"


def is_number(variable):
    return getattr(variable.dtype, "kind", "") in "iuf"


def of_units(variable):
    units = getattr(variable, "units", None)
    if is_number(variable) and units is None:
        yield f"3.1: {variable.name} has no units"
    if units is not None and not UNITS.match(units):
        yield f"3.1: {variable.name} is in {units}"
    name = getattr(variable, "standard_name", None)
    if name is not None and not str(units).startswith(STANDARD_NAMES.get(name, "?")):
        yield f"3.3: {variable.name} is {name} in {units}"
    if name is None and not getattr(variable, "long_name", ""):
        yield f"3.2: {variable.name} has neither long_name nor standard_name"


def of_flags(variable):
    meanings = getattr(variable, "flag_meanings", None)
    values = getattr(variable, "flag_values", None)
    if (meanings is None) != (values is None):
        yield f"3.5: {variable.name} has flag_meanings or flag_values alone"
    if meanings is None or values is None:
        return
    values = numpy.atleast_1d(values)
    if values.dtype != variable.dtype:
        yield f"3.5: flag_values of {variable.name} are of another type"
    if len(values) != len(meanings.split()) or len(set(values)) != len(values):
        yield f"3.5: {variable.name} has {len(values)} flag_values for {meanings}"


def of_axes(variable):
    axis = getattr(variable, "axis", None)
    if axis is not None and axis not in "XYZT":
        yield f"4: {variable.name} is the axis {axis}"
    if axis == "Z" and getattr(variable, "positive", None) not in ("up", "down"):
        yield f"4.3: {variable.name} does not say which way is positive"
    if getattr(variable, "standard_name", "") == "time" or axis == "T":
        if " since " not in getattr(variable, "units", ""):
            yield f"4.4: {variable.name} has no reference time"
        if getattr(variable, "calendar", "standard") not in ("standard", "gregorian", "proleptic_gregorian"):
            yield f"4.4.1: {variable.name} has an unknown calendar"
    if variable.dimensions == (variable.name,) and is_number(variable):
        values = numpy.ma.filled(variable[:].astype(float), numpy.nan)
        if not (numpy.diff(values) > 0).all():
            yield f"5: the coordinate variable {variable.name} does not increase, or is missing"


def of_coordinates(file, variable):
    for name in getattr(variable, "coordinates", "").split():
        if name not in file.variables:
            yield f"5: {variable.name} has the coordinate {name}, which is not there"
            continue
        other = file[name]
        own = other.dimensions[:-1] if other.dtype == "S1" else other.dimensions
        if not set(own) <= set(variable.dimensions):
            yield f"5: {name} has dimensions that {variable.name} lacks"


def of_features(file):
    if file.featureType not in FEATURES:
        yield f"9.4: the featureType {file.featureType}"
    if file.featureType != "trajectory":
        return
    identified = [v for v in file.variables.values() if hasattr(v, "cf_role")]
    if [v.cf_role for v in identified] != ["trajectory_id"]:
        yield "9.5: not just one variable with the cf_role trajectory_id"
        return
    instance = identified[0].dimensions[0]
    names = numpy.atleast_1d(identified[0][:])
    if len({str(name.tobytes()) for name in names}) < len(names):
        yield "9.5: two trajectories of one name"
    axes = {getattr(v, "axis", ""): v for v in file.variables.values()}
    missing_axes = set("XYT") - set(axes)
    if missing_axes:
        yield f"9.1: no coordinates along {sorted(missing_axes)}"
        return
    if axes["X"].dimensions[0] != instance or len(axes["X"].dimensions) != 2:
        yield "H.4.1: x is no array (trajectory, observation)"
        return
    located = numpy.isfinite(filled(axes["X"])) & numpy.isfinite(filled(axes["Y"]))
    for variable in file.variables.values():
        if variable in identified or getattr(variable, "axis", ""):
            continue
        if variable.dimensions != axes["X"].dimensions:
            yield f"9.4: {variable.name} is no part of a trajectory"
            continue
        named = set(getattr(variable, "coordinates", "").split())
        if not {axes["X"].name, axes["Y"].name, axes["T"].name} <= named:
            yield f"9.5: the coordinates of {variable.name} are not all named"
        if (numpy.isfinite(filled(variable)) & ~located).any():
            yield f"9.6: {variable.name} has values where the position is missing"


def filled(variable):
    return numpy.ma.filled(variable[:].astype(float), numpy.nan)
