"""Boxes that are anywhere: the extreme discrepancy, and the largest empty box."""

import operator
from typing import NamedTuple, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows

__all__ = ["EmptyBox", "ExtremeDiscrepancy", "dispersion", "extreme_discrepancy"]


class EmptyBox(NamedTuple):
    """The largest box without points."""

    volume: float
    """Its volume: the dispersion of the points."""
    lower: npt.NDArray[np.float64]
    """Where it begins in each coordinate, shape (d,)."""
    upper: npt.NDArray[np.float64]
    """Where it ends, shape (d,)."""


class ExtremeDiscrepancy(NamedTuple):
    """The worst box."""

    value: float
    """|points inside / n − volume|: the extreme discrepancy, exactly."""
    lower: npt.NDArray[np.float64]
    """Where it begins in each coordinate, shape (d,)."""
    upper: npt.NDArray[np.float64]
    """Where it ends, shape (d,)."""
    closed: bool
    """Whether it is closed and has too many points; otherwise it is open and has too few."""


def dispersion(x: npt.ArrayLike, *, torus: bool = False, limit: SupportsIndex = 1_000_000) -> EmptyBox:
    """Find the largest empty box with sides along the axes in the unit cube, or on the torus.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1]; those on a box's faces are not in it.
    torus : bool
        Whether opposite faces of the cube are the same, so that a box may go on at the other side.
    limit : int
        The most boxes to look at.

    Returns
    -------
    EmptyBox
        Its volume and its corners; exact. On the torus the upper corner may be beyond 1.

    Raises
    ------
    ValueError
        If a number is not in [0, 1], or more boxes than `limit` would have to be looked at.

    Notes
    -----
    Best-first search, each box cut at its most central point; for small d.

    Examples
    --------
    >>> from evenlight import quality
    >>> quality.dispersion([[0.25, 0.5], [0.75, 0.5]]).volume
    0.5
    >>> quality.dispersion([[0.25, 0.5], [0.75, 0.5]], torus=True).volume
    1.0
    """
    volume, lower, upper = _core.dispersion(as_rows(x), bool(torus), operator.index(limit))
    return EmptyBox(volume, np.array(lower), np.array(upper))


def extreme_discrepancy(x: npt.ArrayLike) -> ExtremeDiscrepancy:
    """Find the largest |points inside / n − volume| over all boxes with sides along the axes, wherever they are.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1].

    Returns
    -------
    ExtremeDiscrepancy
        The value and the worst box; exact. At least the star discrepancy, at most 2^d times it.

    Raises
    ------
    ValueError
        If a number is not in [0, 1].

    Notes
    -----
    O(n log n) for d = 1, at most O(n^(2 d − 1)) otherwise: for few points, or two dimensions.

    Examples
    --------
    >>> from evenlight import quality
    >>> worst = quality.extreme_discrepancy([[0.25], [0.75]])
    >>> worst.value, worst.lower.tolist(), worst.upper.tolist()
    (0.5, [0.25], [0.75])
    """
    value, lower, upper, closed = _core.extreme_discrepancy(as_rows(x))
    return ExtremeDiscrepancy(value, np.array(lower), np.array(upper), closed)
