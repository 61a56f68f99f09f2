"""Pair potentials: those that ship, formulas, and functions of your own."""

from __future__ import annotations

from typing import Any, Callable

import numpy

from . import _arguments, _shoal, _versions
from ._taylor import Taylor

Law = Callable[[Any, float], Any]

#: By name and version, what was made of each function that is known here.
KNOWN: dict[tuple[str, str], Callable] = {}


class Potential:
    """A potential of two vehicles as a function of their distance r (m) and the separation s (m).

    Made by potential(). It may stand in a scenario, where a table with a kind would:
    `{"behaviour.attraction_repulsion.potential": law}`.
    """

    def __init__(self, kind: str, options: dict[str, Any]):
        self._named = _shoal.NamedPotential(kind, options)

    def __call__(self, r, s: float):
        """The value at distances r: a number, or an array of any shape."""
        return self.derivatives(r, s)[0]

    def derivatives(self, r, s: float):
        """Value, slope (1/m) and curvature (1/m2), each like r. Raises InputError."""
        found = self._named.derivatives(r, s)
        return found if numpy.ndim(r) else tuple(float(x) for x in found)

    def _setting_(self) -> dict[str, Any]:
        return self._named._setting_()


def potential(law: str | Law, *, slope: Law | None = None, curvature: Law | None = None,
              batch: bool = False, from_m: float | None = None, to_m: float | None = None,
              version: str | None = None, **options: Any) -> Potential:
    """A pair potential.

    law: the kind of one that ships, with its options as keywords
    (`potential("expression", formula="(r - s)^2 / s")`), or a function (r, s) -> number.

    Of a function, slope and curvature are exact by themselves if it is written with operators and
    numpy's functions; else give them as functions, too. With `batch`, it takes arrays: it is then
    asked once, at many distances between from_m and to_m (options("potential", "python") tells their
    defaults), and a run goes by the table that comes of it, as fast as one in C++ and without holding up
    Python's threads; a function too rough for that is refused. Without, it is called by every solver at
    every step.

    A scenario remembers a function by its name and a hash of its code, and of what that uses; version
    replaces the hash, where there is no code or something used cannot be told apart. Raises InputError.
    """
    if isinstance(law, str):
        return Potential(law, options)
    if options:
        raise _shoal.InputError(f"a function has no option \"{next(iter(options))}\"")
    name = getattr(law, "__name__", type(law).__name__)
    answer = _differentiated(law, slope, curvature, name)
    parts = [law] + [part for part in (slope, curvature) if part is not None]
    source = _versions.of_functions(parts) if version is None else _arguments.text(version, "version")
    _shoal.keep_function(name, source, answer)
    KNOWN[name, source] = answer
    limits = {key: limit for key, limit in (("from_m", from_m), ("to_m", to_m)) if limit is not None}
    return Potential("python", {"name": name, "source": source, "batch": batch, **limits})


def learn(known: dict[tuple[str, str], Callable]) -> None:
    """Makes known what another process knows."""
    for (name, source), answer in known.items():
        if (name, source) not in KNOWN:
            _shoal.keep_function(name, source, answer)
            KNOWN[name, source] = answer


def _differentiated(law: Law, slope: Law | None, curvature: Law | None, name: str):
    """(r, s) -> value, slope, curvature."""
    if (slope is None) != (curvature is None):
        raise _shoal.InputError(f"{name}: give slope and curvature, or neither")
    if slope is not None and curvature is not None:
        return lambda r, s: (law(r, s), slope(r, s), curvature(r, s))

    def exact(r, s):
        found = law(Taylor.unknown(r), s)
        if not isinstance(found, Taylor):  # does not depend on r
            found = Taylor(found)
        return tuple(_spread(part, numpy.shape(r), name)
                     for part in (found.value, found.slope, found.curvature))

    try:
        exact(100.0, 100.0)
    except TypeError as error:
        raise _shoal.InputError(f"{name} cannot be differentiated ({error}); write it with operators "
                                "and numpy's functions, or give slope and curvature") from error
    return exact


def _spread(part: Any, shape: tuple[int, ...], name: str):
    """A number for each distance, also of what is the same for all."""
    if numpy.shape(part) not in ((), shape):
        raise _shoal.InputError(f"{name} returned an array of shape {numpy.shape(part)} for distances of shape "
                                f"{shape}; it has to return a number for each")
    return part + numpy.zeros(shape)
