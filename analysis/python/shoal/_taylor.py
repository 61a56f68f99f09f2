"""Exact derivatives of functions written with operators and numpy's functions."""

from __future__ import annotations

from typing import Any, Callable

import numpy

# f(x), f'(x), f''(x), as functions of x and of f(x).
UNARY: dict[Any, Callable] = {
    numpy.negative: lambda x: (-x, -1.0, 0.0),
    numpy.positive: lambda x: (x, 1.0, 0.0),
    numpy.absolute: lambda x: (numpy.abs(x), numpy.sign(x), 0.0),
    numpy.square: lambda x: (x * x, 2.0 * x, 2.0),
    numpy.reciprocal: lambda x: (1.0 / x, -1.0 / x**2, 2.0 / x**3),
    numpy.sqrt: lambda x: (numpy.sqrt(x), 0.5 / numpy.sqrt(x), -0.25 * x**-1.5),
    numpy.exp: lambda x: (numpy.exp(x),) * 3,
    numpy.log: lambda x: (numpy.log(x), 1.0 / x, -1.0 / x**2),
    numpy.sin: lambda x: (numpy.sin(x), numpy.cos(x), -numpy.sin(x)),
    numpy.cos: lambda x: (numpy.cos(x), -numpy.sin(x), -numpy.cos(x)),
    numpy.tan: lambda x: (numpy.tan(x), 1.0 + numpy.tan(x)**2,
                          2.0 * numpy.tan(x) * (1.0 + numpy.tan(x)**2)),
    numpy.arctan: lambda x: (numpy.arctan(x), 1.0 / (1.0 + x * x), -2.0 * x / (1.0 + x * x)**2),
    numpy.sinh: lambda x: (numpy.sinh(x), numpy.cosh(x), numpy.sinh(x)),
    numpy.cosh: lambda x: (numpy.cosh(x), numpy.sinh(x), numpy.cosh(x)),
    numpy.tanh: lambda x: (numpy.tanh(x), 1.0 - numpy.tanh(x)**2,
                           -2.0 * numpy.tanh(x) * (1.0 - numpy.tanh(x)**2)),
}


class Taylor(numpy.lib.mixins.NDArrayOperatorsMixin):
    """A number (or an array of them) that carries its first two derivatives by one unknown."""

    def __init__(self, value, slope=0.0, curvature=0.0):
        self.value, self.slope, self.curvature = value, slope, curvature

    @classmethod
    def unknown(cls, value) -> Taylor:
        return cls(value, numpy.ones_like(value, dtype=float), numpy.zeros_like(value, dtype=float))

    def _chained(self, f, first, second) -> Taylor:
        return Taylor(f, first * self.slope, first * self.curvature + second * self.slope**2)

    def _times(self, other: Taylor) -> Taylor:
        return Taylor(self.value * other.value,
                      self.value * other.slope + other.value * self.slope,
                      self.value * other.curvature + 2.0 * self.slope * other.slope
                      + other.value * self.curvature)

    def _power(self, exponent: Taylor) -> Taylor:
        if numpy.any(exponent.slope) or numpy.any(exponent.curvature):
            return numpy.exp(exponent * numpy.log(self))
        n, x = numpy.asarray(exponent.value, dtype=float), self.value
        with numpy.errstate(divide="ignore", invalid="ignore"):
            first = numpy.where(n == 0, 0.0, n * x**(n - 1))
            second = numpy.where((n == 0) | (n == 1), 0.0, n * (n - 1) * x**(n - 2))
        return self._chained(x**n, first, second)

    def __array_ufunc__(self, ufunc, method, *inputs, **settings):
        if method != "__call__" or settings:
            return NotImplemented
        if ufunc in COMPARISONS:
            return ufunc(*[x.value if isinstance(x, Taylor) else x for x in inputs])
        terms = [x if isinstance(x, Taylor) else Taylor(x) for x in inputs]
        if ufunc in UNARY:
            return terms[0]._chained(*UNARY[ufunc](terms[0].value))
        if ufunc in BINARY:
            return BINARY[ufunc](*terms)
        raise TypeError(f"numpy.{ufunc.__name__} has no derivatives here")

    def __array_function__(self, function, types, inputs, settings):
        if function is numpy.where and not settings:
            return _where(*inputs)
        raise TypeError(f"numpy.{function.__name__} has no derivatives here")

    def __bool__(self):
        return bool(self.value)


def _where(condition, yes, no) -> Taylor:
    yes, no = (x if isinstance(x, Taylor) else Taylor(x) for x in (yes, no))
    return Taylor(*(numpy.where(condition, getattr(yes, of), getattr(no, of))
                    for of in ("value", "slope", "curvature")))


BINARY: dict[Any, Callable] = {
    numpy.add: lambda a, b: Taylor(a.value + b.value, a.slope + b.slope, a.curvature + b.curvature),
    numpy.subtract: lambda a, b: Taylor(a.value - b.value, a.slope - b.slope,
                                        a.curvature - b.curvature),
    numpy.multiply: Taylor._times,
    numpy.divide: lambda a, b: a._times(b._chained(*UNARY[numpy.reciprocal](b.value))),
    numpy.power: Taylor._power,
    numpy.maximum: lambda a, b: _where(a.value >= b.value, a, b),
    numpy.minimum: lambda a, b: _where(a.value <= b.value, a, b),
}
COMPARISONS = {numpy.less, numpy.less_equal, numpy.greater, numpy.greater_equal, numpy.equal,
               numpy.not_equal, numpy.isfinite}
