"""Versions of functions and classes: hashes of their code, and of what it uses."""

from __future__ import annotations

import hashlib
import pickle
import types
from typing import Any, Callable, Iterable

from . import _shoal


def of_functions(functions: Iterable[Callable]) -> str:
    """Of functions together. Raises InputError where there is no code, or something used cannot be told
    apart."""
    return hashlib.sha256(b"|".join(map(_code, functions))).hexdigest()[:16]


def of_class(cls: type) -> str:
    """Of a class with what it inherits. Raises InputError as of_functions() does."""
    parts = []
    for base in cls.__mro__[:-1]:
        for name, value in sorted(vars(base).items()):
            if name in SAYS_NOTHING:
                continue
            function = _function_of(value)
            parts.append(name.encode() + (_content(value, frozenset()) if function is None else _code(function)))
    return hashlib.sha256(b"|".join(parts)).hexdigest()[:16]


# What a class has without being given it, and what changes no number.
SAYS_NOTHING = {"__module__", "__dict__", "__weakref__", "__doc__", "__annotations__", "__qualname__",
                "__static_attributes__", "__firstlineno__"}


def _function_of(value: Any) -> Callable | None:
    if isinstance(value, (staticmethod, classmethod)):
        return value.__func__
    if isinstance(value, property):
        return value.fget
    return value if isinstance(value, types.FunctionType) else None


def _code(function: Any, known: frozenset[int] = frozenset()) -> bytes:
    """What a function does, as bytes: its code, and what it uses from outside."""
    code = getattr(function, "__code__", None)
    if code is None:
        raise _shoal.InputError(f"{function!r} has no code that tells its versions apart; give one: "
                                "version=\"1\"")
    known |= {id(function)}
    cells = [cell.cell_contents for cell in function.__closure__ or ()]
    used = [function.__globals__[name] for name in _names(code) if name in function.__globals__]
    outside = [_content(value, known)
               for value in [*cells, *used, function.__defaults__, function.__kwdefaults__]]
    return repr((_instructions(code), outside)).encode()


def _names(code: types.CodeType) -> list[str]:
    """Names that code looks up, also that inside it."""
    inner = [name for part in code.co_consts if isinstance(part, types.CodeType) for name in _names(part)]
    return [*code.co_names, *inner]


def _instructions(code: types.CodeType) -> tuple:
    return (code.co_code, code.co_names,
            [_instructions(part) if isinstance(part, types.CodeType) else repr(part)
             for part in code.co_consts])


def _content(value: Any, known: frozenset[int]) -> bytes:
    if id(value) in known:  # a function that calls itself
        return b"itself"
    if isinstance(value, types.ModuleType):
        return value.__name__.encode()
    if isinstance(value, types.FunctionType):
        return _code(value, known)
    try:
        return pickle.dumps(value)
    except Exception as error:
        raise _shoal.InputError(f"what the function uses, {value!r}, cannot be told from other versions "
                                "of it; give a version: version=\"1\"") from error
