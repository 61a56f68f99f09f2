"""What there is to choose from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _arguments, _shoal

if TYPE_CHECKING:
    import pandas


def catalogue(family: str | None = None) -> dict[str, dict[str, str]] | dict[str, str]:
    """Names and meanings of everything that can be chosen: of one family, or of all.

    Families are those of `shoal list` (behaviour, solver, potential, current ...), with scenario, set
    and study. Raises InputError for one that is not known.
    """
    families = _shoal.members()
    families["scenario"] = {name: "an experiment to run" for name in _shoal.scenarios()}
    families["set"] = _shoal.sets()
    families["study"] = {name: "trials with their tables and claims" for name in _shoal.studies()}
    if family is None:
        return families
    if family not in families:
        raise _shoal.InputError(f'there is no family "{family}"; known are '
                                + ", ".join(sorted(families)))
    return families[family]


def options(family: str, name: str) -> pandas.DataFrame:
    """The options of one member, with their keys, defaults, units, ranges and meanings."""
    import pandas

    rows = _shoal.options(_arguments.text(family, "family"), _arguments.text(name, "name"))
    return pandas.DataFrame(rows, columns=["key", "default", "unit", "range", "meaning"])


def measures() -> pandas.DataFrame:
    """Everything that is measured of a trial: values, and series against time."""
    import pandas

    rows = [(name, kind, unit, meaning)
            for kind, known in (("value", _shoal.measures()), ("series", _shoal.series()))
            for name, (unit, meaning) in known.items()]
    return pandas.DataFrame(rows, columns=["name", "kind", "unit", "meaning"]).set_index("name")
