"""Points of blue noise: darts, elimination, relaxation."""

from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.arguments import WORD, SeedLike, integer, seed_number, threads

__all__ = ["gaussian", "poisson_disk", "relaxed", "sample_elimination"]

Floats = npt.NDArray[np.float64]


def poisson_disk(
    n: SupportsIndex, dims: SupportsIndex = 2, *, darts: SupportsIndex = 16, seed: SeedLike = None
) -> Floats:
    """Throw darts that are refused near earlier ones, with a distance that shrinks when no place is left.

    Parameters
    ----------
    n : int
        The number of points. More of them never change earlier ones.
    dims : int, default 2
        1 to 8.
    darts : int, default 16
        How many darts are thrown at each distance, for each point there is: more of them fill the set better.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    Returns
    -------
    array of float64, shape (n, dims)
        Points of [0, 1)^dims, which keep their distance across opposite faces too. Every beginning is a nearly full set
        of Poisson disks.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    10 microseconds per point in the plane, 100 in five dimensions.

    References: M. McCool and E. Fiume, *Hierarchical Poisson disk sampling distributions*, Graphics Interface, 94-105
    (1992).

    Examples
    --------
    >>> from evenlight import blue_noise, quality
    >>> x = blue_noise.poisson_disk(1000, seed=1)
    >>> bool(quality.minimum_distance(x[:100]) > 0.06)
    True
    """
    return _points("poisson_disk", (n, dims), integer("darts", darts, 1, WORD), seed)


def sample_elimination(
    n: SupportsIndex, dims: SupportsIndex = 2, *, candidates: SupportsIndex = 8, seed: SeedLike = None
) -> Floats:
    """Take the most crowded of many random points away until n are left, and order these the same way.

    Parameters
    ----------
    n : int
        The number of points.
    dims : int, default 2
        1 to 8.
    candidates : int, default 8
        Random points for each one that is left: more of them lead to larger distances.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    Returns
    -------
    array of float64, shape (n, dims)
        Points of [0, 1)^dims, which keep their distance across opposite faces too. Every beginning is well spread; sets
        of different n have different points.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    40 microseconds per point in the plane, 2 milliseconds in five dimensions.

    References: C. Yuksel, *Sample elimination for generating Poisson disk sample sets*, Comput. Graph. Forum 34(2),
    25-32 (2015).

    Examples
    --------
    >>> from evenlight import blue_noise, quality
    >>> x = blue_noise.sample_elimination(1000, seed=1)
    >>> bool(quality.minimum_distance(x[:100]) > 0.06)
    True
    """
    return _points("sample_elimination", (n, dims), integer("candidates", candidates, 1, WORD), seed)


def gaussian(
    n: SupportsIndex,
    dims: SupportsIndex = 2,
    *,
    steps: SupportsIndex = 200,
    seed: SeedLike = None,
    workers: SupportsIndex = 1,
) -> Floats:
    """Let random points repel each other until no Gaussian blur tells them from an even gray.

    Parameters
    ----------
    n : int
        The number of points.
    dims : int, default 2
        1 to 8.
    steps : int, default 200
        Steps down the gradient: more of them leave less power at low frequencies.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.
    workers : int, default 1
        The most threads to use, -1 for all processors. The points do not depend on it.

    Returns
    -------
    array of float64, shape (n, dims)
        Points of [0, 1)^dims, in no order: only the whole set is blue noise.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    A step takes about 1 microsecond per point in the plane, 7 in three dimensions and 50 in four.

    References: A. Ahmed, J. Ren and P. Wonka, *Gaussian blue noise*, ACM Trans. Graph. 41(6), 260 (2022).

    Examples
    --------
    >>> from evenlight import blue_noise, quality
    >>> spectrum = quality.radial_spectrum(blue_noise.gaussian(400, seed=1), 20)
    >>> bool(spectrum.power[:10].max() < 0.01), bool(spectrum.power[18:].max() > 2)
    (True, True)
    """
    return _points("gaussian", (n, dims), integer("steps", steps, 1, WORD), seed, workers)


def relaxed(x: Any, *, steps: SupportsIndex = 200, workers: SupportsIndex = 1) -> Floats:
    """Move points of one's own as `gaussian` does: a few steps spread them, many forget where they were.

    Parameters
    ----------
    x : array_like, shape (n, dims)
        Points of [0, 1)^dims, in 1 to 8 dimensions.
    steps : int, default 200
        Steps down the gradient.
    workers : int, default 1
        The most threads to use, -1 for all processors. The points do not depend on it.

    Returns
    -------
    array of float64, shape (n, dims)
        The points in their order.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight import blue_noise, points, quality
    >>> x = points.Sobol(2, seed=1).points(0, 256)
    >>> bool(quality.minimum_distance(blue_noise.relaxed(x, steps=20)) > 2 * quality.minimum_distance(x))
    True
    """
    rows = np.ascontiguousarray(x, dtype=np.float64)
    if rows.ndim != 2:
        raise ValueError(f"x must have shape (n, dims), not {rows.shape}")
    return _core.relaxed(rows, _effort(integer("steps", steps, 0, WORD)), threads(workers))


def _points(
    name: str, shape: tuple[SupportsIndex, SupportsIndex], effort: int, seed: SeedLike, workers: SupportsIndex = 1
) -> Floats:
    sizes = integer("n", shape[0], 0, WORD), integer("dims", shape[1], 1, WORD)
    return _core.blue_noise_points(name, sizes, _effort(effort), seed_number(seed), threads(workers))


def _effort(number: int) -> int:
    # whatever is larger is refused by the core together with the number of points, or would take for ever
    return min(number, 2**32 - 1)
