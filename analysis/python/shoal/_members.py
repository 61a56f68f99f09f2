'''Classes of one's own as members of families: behaviours, selections, guidance laws, solvers, measures.

    @shoal.behaviour
    class Follow:
        """Goes to the nearest neighbour, up to a distance."""

        def __init__(self, distance_m: float = 100.0):
            self.distance_m = distance_m

        def target(self, seen):
            if len(seen.positions) == 0:
                return None
            nearest = min(seen.positions, key=numpy.linalg.norm)
            return nearest * (1 - self.distance_m / numpy.linalg.norm(nearest))

    shoal.run("redsea_square", {"behaviour.kind": "follow", "behaviour.follow.distance_m": 80})

A member is known by the `kind` of its class, or by its name in small letters (`follow`; `NearestTwo` is
`nearest_two`). What its constructor takes are its options, with the types of their defaults; more is said of
one by `Annotated[float, "m", "how far to keep away"]`. It is then chosen, swept, listed and described like
any other, in this process and on workers of dask that it hands trials to. A scenario remembers it by a hash
of its code, so that it is not run with another text of it; `version=` replaces the hash, where there is no code or
something used cannot be told apart. Given once more, as a cell of a notebook is run again, a class takes
the place of the one before.

Objects are made for each trial, may be asked by several threads, though by one at a time, and have to
answer the same question with the same answer. What a method raises ends the run, and comes out as it is.
'''

from __future__ import annotations

import inspect
import re
import threading
import typing
from typing import Any

from . import _arguments, _shoal, _versions

#: By family and kind, the classes that are known here and their versions.
KNOWN: dict[tuple[str, str], tuple[type, str]] = {}
LEARNING = threading.Lock()


def behaviour(cls: type | None = None, *, version: str | None = None) -> Any:
    """A class as a behaviour.

    `target(seen)` is given a Neighbourhood and returns where to go: (east, north) in metres from the vehicle, or None to
    hold. Or `targets(seen)`, which is given Neighbourhoods, all vehicles that plan at an instant, and
    returns an array (vehicles, 2), rows of NaN to hold: written with arrays, it is as many times faster.

    With a method `new_memory()`, whatever that returns is kept for each vehicle and given as a second argument
    (to `targets`, a list of them), to be changed in place; a copy of a planner has a deep copy of it.

    It may have, as True: needs_ids (anonymous neighbours are of no use to it), needs_waypoint,
    gives_forces (it returns m/s2 instead of places), needs_clock (targets change as the vehicle moves).
    shoal.testing.check_behaviour() tests what has to hold for all. Raises InputError.
    """
    return _decorated("behaviour", cls, version)


def selection(cls: type | None = None, *, version: str | None = None) -> Any:
    """A class as a selection of neighbours, for behaviours that take one.

    `select(positions)` is given an array (neighbours, 2), metres relative to the vehicle, and returns
    the indices of those to go by: at least one, none twice. Raises InputError.
    """
    return _decorated("selection", cls, version)


def guidance(cls: type | None = None, *, version: str | None = None) -> Any:
    """A class as a guidance law.

    `command(to_target, own)` is given the way to the target (east, north) in metres, zero while it holds,
    and an OwnState, and returns (heading_rad, speed_m_s), the heading counter-clockwise from east, or None
    to drift. It has period_s, the time between two commands, and highest_speed_m_s; it may have, as True,
    takes_forces (it is given m/s2 instead of a way) and needs_motion (it goes by more of the own state than
    the position), and drifting_radius_m, how far from its target a vehicle may drift. Raises InputError.
    """
    return _decorated("guidance", cls, version)


def solver(cls: type | None = None, *, version: str | None = None) -> Any:
    """A class as a solver of smooth problems.

    `solve(problem)` is given a SolverProblem and returns a point. Its evaluations are counted, and
    end by StopSolving where there may be no more: let that pass. The best point that was evaluated is the
    answer, and its status comes from shoal's own check. It may have, as True, takes_bounds and takes_constraints;
    max_evaluations and x_tolerance_m are options of every solver. Raises InputError.
    """
    return _decorated("solver", cls, version)


def measure(cls: type | None = None, *, version: str | None = None) -> Any:
    """A class as a measure, which from now on is part of every trial: of its results, and of what tells trials
    apart.

    It has `values` = {"spread_m": ("m", "mean distance from the centre")}, and `series` likewise, against time.
    `finish(world)` is given a World when the trial has ended and returns a dict: numbers, or None where there
    is none, and for series (times, numbers). `begin(world)` and `observe(world)`, where it has them, are
    called before it begins and every `every_s` seconds (by default some 5). What its constructor takes are
    options, `measure.NAME.OPTION` in scenarios and studies. Raises InputError.
    """
    return _decorated("measure", cls, version)


def learn(known: dict[tuple[str, str], tuple[type, str]]) -> None:
    """Makes known what another process knows."""
    with LEARNING:  # a class that a run of another thread needs is there by then
        for (family, kind), (cls, version) in known.items():
            if (family, kind) not in KNOWN or KNOWN[family, kind][1] != version:
                _keep(family, kind, cls, version)


def _decorated(family: str, cls: type | None, version: str | None) -> Any:
    if cls is None:
        return lambda given: _decorated(family, given, version)
    if not isinstance(cls, type):
        raise _shoal.InputError(f"a {family} of Python is a class, and {cls!r} is none")
    kind = getattr(cls, "kind", None)
    if kind is None:
        kind = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", cls.__name__).lower()
    _keep(family, _arguments.text(kind, f"kind of {cls.__name__}"), cls,
          _versions.of_class(cls) if version is None else _arguments.text(version, "version"))
    return cls


def _keep(family: str, kind: str, cls: type, version: str) -> None:
    summary = (inspect.getdoc(cls) or "a class of Python").splitlines()[0]
    _shoal.keep_class(family, kind, summary, version, cls, _parameters(cls))
    KNOWN[family, kind] = cls, version


def _parameters(cls: type) -> list[tuple[str, Any, str, str]]:
    """(name, default, unit, meaning) of what the constructor takes."""
    constructor: Any = getattr(cls, "__init__")
    if constructor is object.__init__:
        return []
    hints = typing.get_type_hints(constructor, include_extras=True)
    found = []
    for parameter in list(inspect.signature(constructor).parameters.values())[1:]:
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.POSITIONAL_ONLY):
            raise _shoal.InputError(f"the constructor of {cls.__name__} takes {parameter}; its options need names")
        if parameter.default is parameter.empty:
            raise _shoal.InputError(f"the parameter {parameter.name} of {cls.__name__} has no default; give it one")
        said = [text for text in getattr(hints.get(parameter.name), "__metadata__", ()) if isinstance(text, str)]
        unit, meaning = ("", *said)[-2:] if said else ("", f"of {cls.__name__}")
        found.append((parameter.name, parameter.default, unit, meaning))
    return found
