"""Points of triangles: van der Corput sequence, Kronecker lattice, products of triangles."""

import math
from typing import Any, SupportsIndex

import numpy as np

from evenlight import _core
from evenlight.arguments import WORD, SeedLike, integer, seed_number

from .arguments import Floats, real_array, scramble_name

__all__ = ["triangle_kronecker", "triangle_product", "triangle_van_der_corput"]


def triangle_van_der_corput(
    n: SupportsIndex,
    corners: Any,
    start: SupportsIndex = 0,
    scramble: str | bool | None = None,
    seed: SeedLike = None,
) -> Floats:
    """Points of the triangular van der Corput sequence: extensible, one in each of 4^k equal triangles.

    Parallelogram discrepancy 2/(3 sqrt(n)) - 1/(9n) at n = 4^k, and at most 1.147/sqrt(n) at every n up to 4096.
    Scrambled, each point is uniform and the error of smooth means falls as 1/n, at any n.

    Parameters
    ----------
    n : int
        The number of points.
    corners : array_like, shape (3, k)
        The corners, in any number k >= 1 of dimensions. With ``numpy.eye(3)``, points are barycentric coordinates.
    start : int, default 0
        The index of the first point.
    scramble : {None, "owen", "digital_shift"} or bool, default None
        None or False for the points of the paper; "owen" or True permutes the digits at random, nested and in base 4.
    seed : int or numpy.random.Generator, optional
        Of the scramble. The same number always gives the same bits; 0 by default.

    Returns
    -------
    array of float64, shape (n, k)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    20 nanoseconds per point; 150 if scrambled.

    References: K. Basu and A. B. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53(2),
    743-761 (2015).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import warp
    >>> 12 * warp.triangle_van_der_corput(3, np.eye(3), start=4)
    array([[ 2.,  5.,  5.],
           [10.,  1.,  1.],
           [ 4.,  7.,  1.]])
    >>> warp.triangle_van_der_corput(4**5, [[0, 0], [3, 0], [0, 3]], scramble="owen", seed=7).mean(axis=0).round(2)
    array([1., 1.])
    """
    count, first = integer("n", n, 0, WORD), integer("start", start, 0, WORD)
    places = real_array("corners", corners, (3, None))
    if first + count > 2**64:
        raise ValueError(f"start + n must be at most 2^64, not {first + count}")
    out = np.empty((count, places.shape[1]))
    _core.triangle_van_der_corput(first, places.ravel().tolist(), scramble_name(scramble), seed_number(seed), out)
    return out


def triangle_kronecker(
    n: SupportsIndex, corners: Any, angle: float = 3 * math.pi / 8, shift: tuple[float, float] = (0.0, 0.0)
) -> Floats:
    """Exactly n points of a square lattice turned by an angle: discrepancy O(log n / n) if it is a good one.

    Parameters
    ----------
    n : int
        The number of points.
    corners : array_like, shape (3, k)
        The corners, in any number k >= 1 of dimensions.
    angle : float, default 3 pi / 8
        In radians, counterclockwise. Good are those whose tangent is badly approximable, such as 3 pi / 8 and 5 pi / 8.
    shift : pair of float, default (0, 0)
        Moves the lattice before it is turned. Random numbers in [0, 1) make replicates.

    Returns
    -------
    array of float64, shape (n, k)
        By growing distance from the first corner.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    About 430 nanoseconds per point. The lattice is scaled so that exactly n of its points are inside; none is added or
    deleted.

    References: K. Basu and A. B. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53(2),
    743-761 (2015).

    Examples
    --------
    >>> from evenlight import warp
    >>> x = warp.triangle_kronecker(1000, [[0, 0], [1, 0], [0, 1]])
    >>> x.shape, abs(float(x.mean()) - 1 / 3) < 0.002
    ((1000, 2), True)
    """
    places = real_array("corners", corners, (3, None))
    turn, (first, second) = float(angle), map(float, shift)
    if not (math.isfinite(turn) and math.isfinite(first) and math.isfinite(second)):
        raise ValueError(f"angle and shift must be finite, not {angle} and {shift}")
    weights = _core.triangle_kronecker(integer("n", n, 0, 2**40), turn, (first % 1.0, second % 1.0))
    return np.asarray(weights @ places)


def triangle_product(
    n: SupportsIndex,
    corners: Any,
    start: SupportsIndex = 0,
    scramble: str | bool | None = "owen",
    seed: SeedLike = None,
) -> Floats:
    """Points of a product of triangles: a scrambled geometric net, for paths between triangles.

    Coordinate j of a Sobol' point, read two bits at a time, chooses nested triangles of triangle j. Each point is
    uniform, and the error of smooth means falls as (log n)^((s - 1)/2) / n for s triangles. Prefer powers of 4.

    Parameters
    ----------
    n : int
        The number of points.
    corners : array_like, shape (s, 3, k)
        The corners of s triangles.
    start : int, default 0
        The index of the first point.
    scramble : {"owen", "digital_shift", None} or bool, default "owen"
        Nested and in base 4, independent for each triangle; None or False for plain Sobol' digits.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    Returns
    -------
    array of float64, shape (n, s, k)

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    150 nanoseconds per triangle and point.

    References: K. Basu and A. B. Owen, *Scrambled geometric net integration over general product spaces*,
    Found. Comput. Math. 17, 467-496 (2017).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import warp
    >>> x = warp.triangle_product(256, [np.eye(3)] * 2, seed=7)
    >>> x.shape, abs(float((x[:, 0, 0] * x[:, 1, 0]).mean()) - 1 / 9) < 0.002
    ((256, 2, 3), True)
    """
    count, first = integer("n", n, 0, WORD), integer("start", start, 0, WORD)
    places = real_array("corners", corners, (None, 3, None))
    if first + count > 2**64:
        raise ValueError(f"start + n must be at most 2^64, not {first + count}")
    out = np.empty((count, places.shape[0], places.shape[2]))
    _core.triangle_product(first, places, scramble_name(scramble), seed_number(seed), out)
    return out
