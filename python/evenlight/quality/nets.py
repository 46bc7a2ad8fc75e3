"""Points as nets: counting in elementary intervals, and gain coefficients."""

import operator
from collections.abc import Iterable, Sequence
from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows

__all__ = ["gain_coefficients", "is_net", "smallest_t"]


def smallest_t(x: npt.ArrayLike, *, base: SupportsIndex = 2) -> int:
    """Find the smallest t such that points are a (t, m, s)-net, by counting in all elementary intervals.

    Parameters
    ----------
    x : array_like, shape (b^m, s)
        Points in [0, 1], whoever made them; their number is a power of the base.
    base : int
        The base b, at least 2.

    Returns
    -------
    int
        From 0, the best, to m.

    Raises
    ------
    ValueError
        If the number of points is not a power of the base, or a number is not in [0, 1].

    Notes
    -----
    O(n log n) for every shape of interval, of which there are C(k + s − 1, s − 1) of volume b^(−k).

    Examples
    --------
    >>> from evenlight import points, quality
    >>> quality.smallest_t(points.Sobol(2).points(0, 64)), quality.smallest_t(points.Sobol(5).points(0, 64))
    (0, 3)
    """
    return _core.smallest_t(as_rows(x), operator.index(base))


def is_net(x: npt.ArrayLike, t: SupportsIndex, *, base: SupportsIndex = 2) -> bool:
    """Say whether points are a (t, m, s)-net: b^t of them in every elementary interval of volume b^(t − m).

    Parameters
    ----------
    x : array_like, shape (b^m, s)
        Points in [0, 1].
    t : int
        The quality to verify.
    base : int
        The base b, at least 2.

    Returns
    -------
    bool
        Whether they are.

    Raises
    ------
    ValueError
        As `smallest_t`.

    Examples
    --------
    >>> from evenlight import points, quality
    >>> quality.is_net(points.Sobol(2).points(64, 128), 0), quality.is_net(points.Independent(2).points(0, 64), 0)
    (True, False)
    """
    return smallest_t(x, base=base) <= operator.index(t)


def gain_coefficients(
    x: npt.ArrayLike,
    coordinates: Iterable[SupportsIndex],
    *,
    levels: SupportsIndex | None = None,
    base: SupportsIndex = 2,
) -> npt.NDArray[np.float64]:
    """Compute gain coefficients: by how much a nested uniform scramble of the points beats independent points.

    The variance of the mean is Σ Γ σ² / n over sets of coordinates u and vectors of levels k; independent points have
    Γ = 1 everywhere, and a (t, m, s)-net has Γ = 0 where |u| + Σ k ≤ m − t.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1], scrambled or not: a scramble does not change the coefficients.
    coordinates : iterable of int
        The set u, not empty.
    levels : int, optional
        Levels k of each coordinate are 0 to ``levels − 1``; by default as many as b-adic digits number the points.
    base : int
        The base b of the scramble, at least 2.

    Returns
    -------
    ndarray, shape (levels,) * |u|
        Γ of the levels that are its indices, at least 0.

    Raises
    ------
    ValueError
        If a coordinate does not exist, or a number is not in [0, 1].

    Notes
    -----
    O(2^|u| n log n) for each. A. Owen, SIAM J. Numer. Anal. 34, 1997. In base 2, the coefficients of digital nets are
    0 or powers of 2 of at most 2^(t + |u| − 1) (Z. Pan and A. Owen, Math. Comp. 92, 2023).

    Examples
    --------
    >>> from evenlight import points, quality
    >>> x = points.Sobol(2).points(0, 4)
    >>> quality.gain_coefficients(x, [0, 1], levels=2).tolist()
    [[0.0, 2.0], [2.0, 1.0]]
    """
    rows, b = as_rows(x), operator.index(base)
    d = rows.shape[1]
    chosen = [operator.index(coordinate) for coordinate in coordinates]
    if not chosen or len(set(chosen)) != len(chosen) or not all(0 <= coordinate < d for coordinate in chosen):
        raise ValueError(f"coordinates must be different numbers from 0 to {d - 1}, at least one, not {chosen}")
    if b < 2:
        raise ValueError(f"base must be at least 2, not {b}")
    count = _digits(len(rows), b) if levels is None else operator.index(levels)
    gains = np.empty((count,) * len(chosen))
    for index in np.ndindex(gains.shape):
        gains[index] = _core.gain_coefficient(rows, _levels(d, chosen, index), b)
    return gains


def _digits(n: int, base: int) -> int:
    """How many digits number n points."""
    digits = 1
    while base**digits < n:
        digits += 1
    return digits


def _levels(d: int, chosen: Sequence[int], index: Sequence[int]) -> list[int | None]:
    """The levels of all coordinates; None for those that are not chosen."""
    levels: list[int | None] = [None] * d
    for coordinate, level in zip(chosen, index, strict=True):
        levels[coordinate] = level
    return levels
