"""Tests for what one adds to shoal."""

from __future__ import annotations

from typing import Any

from . import _arguments, _members, _shoal


def check_behaviour(behaviour: str | type, options: dict[str, Any] | None = None, *,
                    turn_step_deg: float = 1.0, tolerance_m: float = 0.02) -> None:
    """Holds a behaviour to what holds for every one, those of shoal included, on swarms that are drawn, always
    the same: targets are finite also among degenerate neighbours, and the same when asked again and for several
    vehicles together; a vehicle that hears no other holds, and so does one among strangers, if and only if
    ids are needed; the orientation and the origin of the frame, those of the plan, the numbers of its slots
    and the order of the neighbours mean nothing.

    behaviour: its kind, or a class given to shoal.behaviour(). turn_step_deg: of one that searches rotations by
    steps, its step. tolerance_m: between targets that should be the same. Raises AssertionError with what does
    not hold, an example for each, and InputError.
    """
    if isinstance(behaviour, type):
        kinds = [kind for (family, kind), (cls, _) in _members.KNOWN.items()
                 if family == "behaviour" and cls is behaviour]
        if not kinds:
            raise _shoal.InputError(f"{behaviour.__name__} is no behaviour yet; give it to shoal.behaviour()")
        behaviour = kinds[0]
    found = _shoal.violations(_arguments.text(behaviour, "behaviour"), _arguments.table(options, "options"),
                              turn_step_deg, tolerance_m)
    if found:
        raise AssertionError("\n".join([f"behaviour {behaviour}:", *found]))
