"""Axes of one size in a grid, and what a figure refuses to hold."""

import math

import matplotlib.pyplot as plt
import style

MOST = 12  # panels of one measure: a page of them


class TooMuch(Exception):
    """More than a figure can show; says how to select some."""


def across(count):
    """Small panels side by side."""
    most = 4 if style.wide() else 2
    rows = math.ceil(count / most)
    return math.ceil(count / rows)


def grid(count, columns, height, **shared):
    """A figure and so many axes in rows, each row as many inches high."""
    rows = math.ceil(count / columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False, **shared)
    figure.set_figheight(rows * height)
    for ax in axes.flat[count:]:
        ax.remove()
    return figure, list(axes.flat[:count])


def panel_height(columns):
    """Of axes with so many beside one another."""
    return max(1.75, plt.rcParams["figure.figsize"][1] / columns)
