"""Arguments as the library takes them. What does not fit is refused with InputError, by its name."""

from __future__ import annotations

import operator
import os
import reprlib
from typing import Any, Callable, Mapping

import numpy

from . import _shoal


def whole(value: Any, what: str, least: int | None = None, most: int | None = None) -> int:
    """An integer, also one of numpy's."""
    try:
        number = operator.index(value)
    except TypeError:
        raise _refused(what, value, "an integer") from None
    if isinstance(value, (bool, numpy.bool_)):
        raise _refused(what, value, "an integer")
    if number.bit_length() > 63:
        raise _shoal.InputError(f"{what} is an integer of more than 64 bits, which is too large")
    if (least is not None and number < least) or (most is not None and number > most):
        raise _refused(what, number, f"at least {least}" if most is None else f"from {least} to {most}")
    return number


def flag(value: Any, what: str) -> bool:
    """True or False, also numpy's."""
    if not isinstance(value, (bool, numpy.bool_)):
        raise _refused(what, value, "True or False")
    return bool(value)


def function(value: Any, what: str) -> Callable[..., Any] | None:
    """Something to call, or None."""
    if value is not None and not callable(value):
        raise _refused(what, value, "a function, or None")
    return value


def path(value: Any, what: str) -> str:
    """A file or folder."""
    return text(os.fspath(value) if isinstance(value, os.PathLike) else value, what, "a path")


def text(value: Any, what: str, taken: str = "text") -> str:
    """Text that is not empty, of characters that can be written."""
    if not isinstance(value, str):
        raise _refused(what, value, taken)
    if not value:
        raise _shoal.InputError(f"{what} is empty; it takes {taken}")
    if "\0" in value:
        raise _refused(what, value, f"{taken} without NUL characters")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise _refused(what, value, f"{taken} that is valid Unicode") from None
    return value


def table(value: Any, what: str) -> dict[str, Any]:
    """A dict of settings; None stands for an empty one."""
    if value is not None and not isinstance(value, Mapping):
        raise _refused(what, value, "a dict")
    return dict(value or {})


def source(value: Any, what: str) -> dict[str, Any] | str:
    """A scenario or study: its name or file as text, or a dict."""
    if isinstance(value, Mapping):
        return dict(value)
    if not isinstance(value, (str, os.PathLike)):
        raise _refused(what, value, "a name, a file, or a dict")
    return path(value, what)


def _refused(what: str, value: Any, taken: str) -> _shoal.InputError:
    return _shoal.InputError(f"{what} is {reprlib.repr(value)}; it takes {taken}")
