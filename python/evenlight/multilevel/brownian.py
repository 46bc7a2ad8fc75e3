"""Brownian motion from uniform numbers: increments in order of time, by a bridge, or by principal components.

In order of time for plain and multilevel Monte Carlo: it is the cheapest. A bridge or principal components for evenly
spread points: the first few columns then decide most of the path, where such points are best.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.warp import Gaussian

__all__ = ["CONSTRUCTIONS", "brownian_increments", "normals"]

Array = NDArray[np.float64]

_GAUSSIAN = Gaussian()


def normals(u: Array) -> Array:
    """Standard normal numbers of uniform ones in [0, 1), of the same shape, by the inverse of the distribution."""
    return np.asarray(_GAUSSIAN.map(u[..., np.newaxis]))[..., 0]


def brownian_increments(u: Any, *, horizon: float = 1.0, construction: str = "incremental", factors: int = 1) -> Array:
    """Increments of Brownian motion over equal time steps.

    Parameters
    ----------
    u : array_like, shape (n, steps * factors)
        Uniform numbers in [0, 1). Column j belongs to factor j mod `factors`, so that the columns that matter most
        to every factor come first.
    horizon : float
        The time at the end, above 0.
    construction : {"incremental", "bridge", "pca"}
        Which normal number moves what. "incremental": the first increment first. "bridge": first the end, then the
        middle, then the quarters (any number of steps; halves are as equal as they can be). "pca": the principal
        components of the path, the largest first, which minimize the variance left to later columns.
    factors : int
        Independent motions.

    Returns
    -------
    ndarray of float64, shape (n, steps), or (n, steps, factors) if there are several
        Independent normal numbers of variance ``horizon / steps``.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Notes
    -----
    Cost per number: one inverse of the normal distribution (about 4 nanoseconds), and for "bridge" as much
    again, for "pca" ``2 * steps`` operations, in a matrix product.

    References: R. E. Caflisch, W. Morokoff and A. B. Owen, "Valuation of mortgage backed securities using Brownian
    bridges to reduce effective dimension", J. Comput. Finance 1(1), 27-46 (1997); P. A. Acworth, M. Broadie and
    P. Glasserman, "A comparison of some Monte Carlo and quasi Monte Carlo techniques for option pricing", MCQMC 1996.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import brownian_increments
    >>> u = [[0.975, 0.5, 0.5, 0.5]]
    >>> brownian_increments(u).round(2)
    array([[0.98, 0.  , 0.  , 0.  ]])
    >>> brownian_increments(u, construction="bridge").round(2)
    array([[0.49, 0.49, 0.49, 0.49]])
    >>> brownian_increments(u, construction="pca").round(2)
    array([[0.64, 0.57, 0.42, 0.22]])
    """
    uniform = np.asarray(u, np.float64)
    if uniform.ndim != 2 or factors < 1 or uniform.shape[1] == 0 or uniform.shape[1] % factors:
        raise ValueError(f"u must have shape (n, steps * {factors}), not {uniform.shape}")
    if not 0.0 < horizon < np.inf:
        raise ValueError(f"horizon must be above 0 and finite, not {horizon}")
    if construction not in CONSTRUCTIONS:
        raise ValueError(f"unknown construction {construction!r}; known: {', '.join(CONSTRUCTIONS)}")
    steps = uniform.shape[1] // factors
    z = normals(uniform)
    z *= np.sqrt(horizon / steps)
    if factors == 1:
        return CONSTRUCTIONS[construction](z)
    motions = np.ascontiguousarray(z.reshape(len(z), steps, factors).transpose(0, 2, 1)).reshape(-1, steps)
    return CONSTRUCTIONS[construction](motions).reshape(len(z), factors, steps).transpose(0, 2, 1)


def _incremental(z: Array) -> Array:
    return z


def _bridge(z: Array) -> Array:
    """Every interval is halved until it is one step; the increment of an interval is shared among its halves.

    With a steps on the left and b on the right, the left part is a / (a + b) of the increment plus a normal number of
    variance a b / (a + b) steps.
    """
    steps = z.shape[1]
    columns = np.empty((steps, len(z)))
    columns[0] = z[:, 0] * np.sqrt(steps)
    for column, (starts, middles, left, right) in _halvings(steps):
        whole = columns[starts]
        share = (left / (left + right))[:, np.newaxis]
        spread = np.sqrt(left * right / (left + right))[:, np.newaxis]
        first = share * whole + spread * z[:, column : column + len(starts)].T
        columns[middles] = whole - first
        columns[starts] = first
    return columns.T


@lru_cache(maxsize=64)
def _halvings(steps: int) -> tuple[tuple[int, tuple[Any, Any, Any, Any]], ...]:
    """For each generation of intervals: the column of its first number; starts, middles, lengths of both halves."""
    found = []
    intervals, column = [(0, steps)], 1
    while intervals := [(start, stop) for start, stop in intervals if stop - start > 1]:
        starts, stops = np.array(intervals).T
        middles = (starts + stops + 1) // 2
        found.append((column, (starts, middles, middles - starts, stops - middles)))
        column += len(intervals)
        halves = zip(starts.tolist(), middles.tolist(), stops.tolist(), strict=True)
        intervals = [part for start, middle, stop in halves for part in ((start, middle), (middle, stop))]
    return tuple(found)


def _pca(z: Array) -> Array:
    return z @ _components(z.shape[1])


@lru_cache(maxsize=16)
def _components(steps: int) -> Array:
    """An orthogonal matrix: row j is what component j of the path does to the increments.

    Eigenvectors of the covariance min(i, k) are sines of i (2 j - 1) π / (2 steps + 1); scaled by the roots of the
    eigenvalues and differenced they become cosines.
    """
    angles = (2.0 * np.arange(1, steps + 1) - 1.0) * np.pi / (2 * steps + 1)
    times = np.arange(1, steps + 1) - 0.5
    return np.asarray(2.0 / np.sqrt(2 * steps + 1) * np.cos(np.outer(angles, times)))


CONSTRUCTIONS: dict[str, Callable[[Array], Array]] = {"incremental": _incremental, "bridge": _bridge, "pca": _pca}
"""The constructions by their names: from normal numbers of the variance of a step to increments, shape (n, steps)."""
