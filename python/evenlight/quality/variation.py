"""The variation of an integrand in the sense of Hardy and Krause, and the error bound that goes with it."""

import itertools
import math
import operator
from collections.abc import Callable
from typing import Literal, NamedTuple, SupportsIndex

import numpy as np

from .pick_freeze import Array, Integrand, values
from .star import StarDiscrepancy

__all__ = ["Variation", "hardy_krause_variation", "koksma_hlawka_bound"]

Derivative = Callable[[Array, tuple[int, ...]], Array]

_MOST_POINTS = 1 << 24


class Variation(NamedTuple):
    """The variation in the sense of Hardy and Krause, with the anchor at (1, …, 1)."""

    value: float
    """The sum of `vitali`."""
    kind: Literal["lower", "quadrature"]
    """Either "lower": differences on a grid, a lower bound that is exact if no mixed derivative changes its sign
    within a cell; or "quadrature": integrals of derivatives by the midpoint rule."""
    vitali: dict[tuple[int, ...], float]
    """The variation in the sense of Vitali over each face: by the coordinates that are not 1."""


def hardy_krause_variation(
    f: Integrand | None,
    d: SupportsIndex,
    *,
    size: SupportsIndex = 32,
    derivative: Derivative | None = None,
) -> Variation:
    """Compute the variation of a function of the unit cube in the sense of Hardy and Krause.

    Parameters
    ----------
    f : callable or None
        Takes a block of points, shape (n, d), in [0, 1]; returns shape (n,). None if derivatives are given.
    d : int
        The number of coordinates.
    size : int
        Cells of the grid in each direction: (size + 1)^d values of f, or size^|u| of each derivative; 2^24 at most.
    derivative : callable, optional
        ``derivative(x, u)``: the mixed derivative of f, once by each coordinate of the tuple u, at the rows of x, shape
        (n, d), whose other coordinates are 1.

    Returns
    -------
    Variation
        The value, what it is worth, and the parts it is the sum of.

    Raises
    ------
    ValueError
        If both or none of f and derivative are given, the grid is too large, or a value is not finite.

    Notes
    -----
    V is the sum over all sets of coordinates u of the variation in the sense of Vitali of f on the face where the
    others are 1, which for smooth f is ∫ |∂ f / ∂ x_u|. Functions with a jump that is not along the axes have infinite
    variation: then the value grows with size.

    Examples
    --------
    >>> from evenlight import quality
    >>> variation = quality.hardy_krause_variation(lambda x: x[:, 0] * x[:, 1], 2)
    >>> round(variation.value, 12), variation.kind
    (3.0, 'lower')
    >>> quality.hardy_krause_variation(None, 1, derivative=lambda x, u: 2 * x[:, 0]).value
    1.0
    """
    dims, cells = operator.index(d), operator.index(size)
    if dims < 1 or cells < 1:
        raise ValueError(f"d and size must be at least 1, not {dims} and {cells}")
    if (cells + 1) ** dims > _MOST_POINTS:
        raise ValueError(
            f"a grid of {cells} cells in {dims} dimensions has more than 2^24 points; choose a smaller size"
        )
    faces = [u for order in range(1, dims + 1) for u in itertools.combinations(range(dims), order)]
    if (f is None) == (derivative is None):
        raise ValueError("give either f or derivative")
    if f is not None:
        grid = _grid(np.linspace(0, 1, cells + 1), dims)
        table = values(f, grid).reshape((cells + 1,) * dims)
        vitali = {u: _differences(table, u) for u in faces}
        return Variation(math.fsum(vitali.values()), "lower", vitali)
    assert derivative is not None
    vitali = {u: _integral(derivative, u, dims, cells) for u in faces}
    return Variation(math.fsum(vitali.values()), "quadrature", vitali)


def koksma_hlawka_bound(variation: Variation | float, discrepancy: StarDiscrepancy | float) -> float:
    """Bound the error of the mean over points by V D*: the Koksma–Hlawka inequality.

    Parameters
    ----------
    variation : Variation or float
        The variation of the integrand in the sense of Hardy and Krause.
    discrepancy : StarDiscrepancy or float
        The star discrepancy of the points, exact or an upper bound.

    Returns
    -------
    float
        |mean over the points − integral| is at most this. As good as the variation is: that of a grid is a lower bound.

    Raises
    ------
    ValueError
        If the discrepancy is only a lower bound, or a number is negative.

    Examples
    --------
    >>> from evenlight import points, quality
    >>> x = points.Sobol(2).points(0, 64)
    >>> bound = quality.koksma_hlawka_bound(3.0, quality.star_discrepancy(x))
    >>> bool(abs((x[:, 0] * x[:, 1]).mean() - 0.25) <= bound)
    True
    """
    if isinstance(discrepancy, StarDiscrepancy) and discrepancy.kind == "lower":
        raise ValueError("a lower bound of the discrepancy bounds no error; use an exact one or 'bracketing'")
    value = variation.value if isinstance(variation, Variation) else float(variation)
    if not (value >= 0 and discrepancy >= 0):
        raise ValueError(f"variation and discrepancy must be at least 0, not {value} and {float(discrepancy)}")
    return value * float(discrepancy)


def _grid(line: Array, dims: int) -> Array:
    """All points whose coordinates are of a line."""
    return np.stack(np.meshgrid(*[line] * dims, indexing="ij"), axis=-1).reshape(-1, dims)


def _differences(table: Array, u: tuple[int, ...]) -> float:
    """The sum of absolute mixed differences on the face where the coordinates that are not of u are 1."""
    face = table[tuple(slice(None) if j in u else -1 for j in range(table.ndim))]
    for axis in range(face.ndim):
        face = np.diff(face, axis=axis)
    return float(np.abs(face).sum())


def _integral(derivative: Derivative, u: tuple[int, ...], dims: int, cells: int) -> float:
    """The integral of an absolute derivative over a face, by the midpoint rule."""
    inner = _grid((np.arange(cells) + 0.5) / cells, len(u))
    x = np.ones((len(inner), dims))
    x[:, list(u)] = inner
    return float(np.abs(values(lambda rows: derivative(rows, u), x)).mean())
