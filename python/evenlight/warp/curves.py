"""Space-filling curves: Hilbert, Morton and Gray code, points along them, and clouds of points in their order."""

from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.arguments import WORD, SeedLike, integer, seed_number, threads

from .arguments import Floats, real_array
from .base import Warp

__all__ = [
    "Gray",
    "Hilbert",
    "Morton",
    "curve_cells",
    "curve_index",
    "curve_points",
    "curve_sort",
    "hilbert",
    "hilbert_inverse",
    "hilbert_sort",
]

SOURCES = ("centered", "stratified", "van_der_corput", "owen")


class _CurveWarp(Warp):
    def __init__(self, dims: SupportsIndex) -> None:
        super().__init__(dims=integer("dims", dims, 2, 32))


class Hilbert(_CurveWarp):
    """The Hilbert curve: the interval to the cube, so that neighbors on the line are neighbors in the cube.

    Parameters
    ----------
    dims : int
        2 to 32. The cube has min(32, 64 / dims) binary digits on each axis; points are centers of its cells.

    Notes
    -----
    References: J. Skilling, *Programming the Hilbert curve*, AIP Conf. Proc. 707, 381-387 (2004).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Hilbert(2).map([[0.125], [0.375]]).round(6)
    array([[0.25, 0.25],
           [0.25, 0.75]])
    """

    warp = "hilbert"


class Morton(_CurveWarp):
    """The Morton (Z) curve: cheaper than Hilbert's, with jumps.

    Parameters
    ----------
    dims : int
        2 to 32.

    Notes
    -----
    References: G. M. Morton, *A computer oriented geodetic data base*, IBM (1966).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Morton(2).map([[0.25], [0.5]]).round(6)
    array([[0. , 0.5],
           [0.5, 0. ]])
    """

    warp = "morton"


class Gray(_CurveWarp):
    """The Gray-code curve: one coordinate changes at a time, by one binary digit.

    Parameters
    ----------
    dims : int
        2 to 32.

    Notes
    -----
    References: C. Faloutsos, *Gray codes for partial match and range queries*, IEEE Trans. Softw. Eng. 14(10),
    1381-1393 (1988).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Gray(2).map([[0.25], [0.5]]).round(6)
    array([[0.25, 0.5 ],
           [0.5 , 0.5 ]])
    """

    warp = "gray"


def hilbert(t: Any, dims: SupportsIndex) -> Any:
    """Points of the Hilbert curve.

    Parameters
    ----------
    t : array_like, shape (...)
        Numbers in [0, 1).
    dims : int
        1 to 32.

    Returns
    -------
    array, shape (..., dims)
        In the precision of `t`.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    About 80 nanoseconds per point. ``hilbert_inverse(hilbert(t, dims))`` is `t` to the last bit that dims * bits <= 64
    can hold.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.hilbert([0.0, 0.5], 2).round(6)
    array([[0. , 0. ],
           [0.5, 0.5]])
    """
    numbers = np.asarray(t)[..., None]
    if integer("dims", dims, 1, 32) == 1:
        return numbers.astype(np.float32 if numbers.dtype == np.float32 else np.float64)
    return Hilbert(dims).map(numbers)


def hilbert_inverse(x: Any) -> Any:
    """The numbers of points on the Hilbert curve.

    Parameters
    ----------
    x : array_like, shape (..., dims)
        Points of the unit cube, in 1 to 32 dimensions.

    Returns
    -------
    array, shape (...)
        Where the curve enters the cell of each point: numbers in [0, 1).

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight import warp
    >>> float(warp.hilbert_inverse(warp.hilbert(0.3125, 5)))
    0.3125
    """
    points = np.asarray(x)
    dims = points.shape[-1] if points.ndim else 0
    if dims == 1:
        return points[..., 0].astype(np.float32 if points.dtype == np.float32 else np.float64)
    if not 1 <= dims <= 32:
        raise ValueError(f"x must have 1 to 32 coordinates in its last axis, not shape {points.shape}")
    return Hilbert(dims).invert(points)[..., 0]


def curve_cells(index: Any, dims: SupportsIndex, bits: SupportsIndex, curve: str = "hilbert") -> npt.NDArray[np.uint32]:
    """The cells of a grid that a curve goes through.

    Parameters
    ----------
    index : array_like of int, shape (n,)
        0 to 2^(dims * bits) - 1.
    dims, bits : int
        The axes of the grid, and the binary digits of each; dims * bits <= 64.
    curve : {"hilbert", "morton", "gray"}, default "hilbert"

    Returns
    -------
    array of uint32, shape (n, dims)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.curve_cells(range(4), dims=2, bits=1).tolist()
    [[0, 0], [0, 1], [1, 1], [1, 0]]
    """
    axes, digits = integer("dims", dims, 1, 32), integer("bits", bits, 1, 32)
    return _core.curve_cells(curve, _words("index", index, axes * digits, 1), axes, digits)


def curve_index(cells: Any, bits: SupportsIndex, curve: str = "hilbert") -> npt.NDArray[np.uint64]:
    """The places of cells on a curve: the inverse of `curve_cells`.

    Parameters
    ----------
    cells : array_like of int, shape (n, dims)
        0 to 2^bits - 1.
    bits : int
        The binary digits of each axis; dims * bits <= 64.
    curve : {"hilbert", "morton", "gray"}, default "hilbert"

    Returns
    -------
    array of uint64, shape (n,)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.curve_index([[0, 0], [0, 1], [1, 1], [1, 0]], bits=1).tolist()
    [0, 1, 2, 3]
    """
    digits = integer("bits", bits, 1, 32)
    return _core.curve_index(curve, _words("cells", cells, digits, 2).astype(np.uint32), digits)


def curve_points(
    n: SupportsIndex,
    dims: SupportsIndex,
    source: str = "stratified",
    start: SupportsIndex = 0,
    seed: SeedLike = None,
    curve: str = "hilbert",
) -> Floats:
    """Points along a curve, made of points of the interval: discrepancy O(n^(-1/dims)) at any n.

    The variance of a mean over stratified or scrambled points is O(n^(-1 - 2/dims)) for Lipschitz functions and O(n^(-1
    - 1/dims)) for those that jump on a smooth surface; n need not be a power of anything.

    Parameters
    ----------
    n : int
        The number of points.
    dims : int
        1 to 32.
    source : {"stratified", "centered", "van_der_corput", "owen"}, default "stratified"
        One random point in each of n equal intervals; their middles; the van der Corput sequence, which can be
        extended; the same, scrambled. Points of "stratified" and "owen" are uniform in the cube.
    start : int, default 0
        The index of the first point, for the two sequences.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.
    curve : {"hilbert", "morton", "gray"}, default "hilbert"

    Returns
    -------
    array of float64, shape (n, dims)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    100 to 150 nanoseconds per point.

    References: Z. He and A. B. Owen, *Extensible grids: uniform sampling on a space filling curve*, J. R. Stat. Soc. B
    78(4), 917-931 (2016).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.curve_points(4, 2, source="centered")
    array([[0.25, 0.25],
           [0.25, 0.75],
           [0.75, 0.75],
           [0.75, 0.25]])
    """
    count, first = integer("n", n, 0, WORD), integer("start", start, 0, WORD)
    if source not in SOURCES:
        raise ValueError(f"unknown source {source!r}; known: {', '.join(SOURCES)}")
    if first and source in ("stratified", "centered"):
        raise ValueError(f"start must be 0 for source {source!r}, whose intervals are all used, not {first}")
    out = np.empty((count, integer("dims", dims, 1, 32)))
    _core.curve_points(curve, source, (count, first), seed_number(seed), out)
    return out


def curve_sort(
    x: Any, curve: str = "hilbert", bounds: Any = None, workers: SupportsIndex = 1
) -> npt.NDArray[np.uint32]:
    """The order of points along a curve: neighbors in the list are near each other.

    Parameters
    ----------
    x : array_like, shape (n, dims)
        Points, in 1 to 32 dimensions; n < 2^32.
    curve : {"hilbert", "morton", "gray"}, default "hilbert"
    bounds : array_like, shape (2, dims), optional
        The lower and the upper corner of the box that the curve fills; the box of all points by default. Points outside
        count as on its sides.
    workers : int, optional
        The most threads to use, -1 for all processors. The order does not depend on it.

    Returns
    -------
    array of uint32, shape (n,)
        ``x[order]`` is sorted. Points in one cell of the grid of 64 bits keep their order.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    By the first 20 to 32 digits of the keys, and all 64 where these are equal. 4096 points in the plane take a fifth of
    a millisecond.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.curve_sort([[0.9, 0.1], [0.1, 0.1], [0.9, 0.9], [0.1, 0.9]], bounds=[[0, 0], [1, 1]]).tolist()
    [1, 3, 2, 0]
    """
    cloud = np.ascontiguousarray(x, dtype=np.float64)
    if cloud.ndim != 2 or not 1 <= cloud.shape[1] <= 32 or len(cloud) >= 2**32:
        raise ValueError(f"x must have shape (n, dims), n < 2^32 and dims from 1 to 32, not {cloud.shape}")
    if len(cloud) == 0:
        return np.empty(0, dtype=np.uint32)
    columns = np.ascontiguousarray(cloud.T)  # of which the extremes are found ten times as fast
    lower, upper = columns.min(axis=1), columns.max(axis=1)
    if not np.isfinite([lower, upper]).all():
        raise ValueError("x must be finite")
    if bounds is not None:
        lower, upper = real_array("bounds", bounds, (2, cloud.shape[1]))
        if not (lower < upper).all():
            raise ValueError("bounds must have a lower corner below the upper one")
    if cloud.shape[1] == 1:
        cloud = np.clip(cloud, lower, upper)
    return _core.curve_order(curve, cloud, lower.tolist(), upper.tolist(), threads(workers))


def hilbert_sort(x: Any, bounds: Any = None, workers: SupportsIndex = 1) -> npt.NDArray[np.uint32]:
    """The order of points along the Hilbert curve: `curve_sort` under the name that sequential quasi-Monte Carlo knows.

    Parameters
    ----------
    x : array_like, shape (n, dims)
        Points, in 1 to 32 dimensions; n < 2^32.
    bounds : array_like, shape (2, dims), optional
        The lower and the upper corner of the box that the curve fills; the box of all points by default.
    workers : int, optional
        The most threads to use, -1 for all processors. The order does not depend on it.

    Returns
    -------
    array of uint32, shape (n,)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import points, warp
    >>> x = points.Independent(2, seed=1).points(0, 1000)
    >>> steps = np.diff(x[warp.hilbert_sort(x)], axis=0)
    >>> float(np.linalg.norm(steps, axis=1).mean()) < 0.05
    True
    """
    return curve_sort(x, "hilbert", bounds, workers)


def _words(name: str, values: Any, digits: int, axes: int) -> npt.NDArray[np.uint64]:
    array = np.asarray(list(values) if isinstance(values, range) else values)
    if array.size and not np.issubdtype(array.dtype, np.integer):
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.ndim != axes:
        raise ValueError(f"{name} must have {axes} axes, not shape {array.shape}")
    most = 2 ** min(digits, 64) - 1
    if array.size and not (array.min() >= 0 and int(array.max()) <= most):
        raise ValueError(f"{name} must be from 0 to {most}, not from {array.min()} to {array.max()}")
    return np.ascontiguousarray(array, dtype=np.uint64)
