"""Points as textures: distances, the periodogram and its radial mean, pair correlation; all on the torus."""

from typing import Any, NamedTuple, SupportsIndex

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from .rows import as_rows

__all__ = [
    "PairCorrelation",
    "RadialSpectrum",
    "minimum_distance",
    "pair_correlation",
    "periodogram",
    "radial_spectrum",
]


class RadialSpectrum(NamedTuple):
    """The periodogram averaged over rings of frequencies."""

    frequency: npt.NDArray[np.float64]
    """The mean radius |k| of each ring, shape (rings,)."""
    power: npt.NDArray[np.float64]
    """The mean power of each ring; 1 for independent points, near 0 at low frequencies for blue noise."""
    anisotropy: npt.NDArray[np.float64]
    """Variance over squared mean of the power in each ring, in dB; 0 dB for independent points, NaN or infinite where a
    ring has no power."""


class PairCorrelation(NamedTuple):
    """How often pairs of points are at some distance."""

    distance: npt.NDArray[np.float64]
    """The middle of each interval of distances, shape (bins,)."""
    density: npt.NDArray[np.float64]
    """The pairs in it, in units of what independent points have."""


def minimum_distance(x: npt.ArrayLike, *, torus: bool = True) -> float:
    """Find the smallest distance between two points.

    Parameters
    ----------
    x : array_like, shape (n, d)
        At least two points in [0, 1].
    torus : bool
        Whether opposite faces of the cube are the same; by default they are.

    Returns
    -------
    float
        The Euclidean distance of the closest pair.

    Raises
    ------
    ValueError
        If a number is not in [0, 1], or there is one point only.

    Notes
    -----
    By SciPy's k-d tree, O(n log n) for small d.

    Examples
    --------
    >>> from evenlight import quality
    >>> x = [[0.125, 0.5], [0.875, 0.5]]
    >>> quality.minimum_distance(x), quality.minimum_distance(x, torus=False)
    (0.25, 0.75)
    """
    rows = _checked(x)
    if len(rows) < 2:
        raise ValueError("a distance needs at least two points")
    tree = _torus(rows) if torus else cKDTree(rows)
    distances = np.asarray(tree.query(tree.data, k=2)[0])
    return float(distances[:, 1].min())


def periodogram(x: npt.ArrayLike, size: SupportsIndex = 64) -> npt.NDArray[np.float64]:
    """Compute the periodogram |Σ exp(−2πi k·x)|² / n of points in the plane at whole frequencies.

    Parameters
    ----------
    x : array_like, shape (n, 2)
        Points in [0, 1].
    size : int
        Frequencies run from −size to size in both directions.

    Returns
    -------
    ndarray, shape (2 size + 1, 2 size + 1)
        The power at frequency (i − size, j − size); n in the middle, 1 on average for independent points.

    Raises
    ------
    ValueError
        If the points are not in the unit square, or the size is less than 1.

    Notes
    -----
    O(n size²), a product of matrices.

    Examples
    --------
    >>> from evenlight import quality
    >>> quality.periodogram([[0, 0], [0.5, 0]], 1).round(12).tolist()
    [[0.0, 0.0, 0.0], [2.0, 2.0, 2.0], [0.0, 0.0, 0.0]]
    """
    rows, most = _in_plane(x), int(size.__index__())
    if most < 1:
        raise ValueError(f"size must be at least 1, not {most}")
    frequencies = np.arange(-most, most + 1)
    first, second = (np.exp(-2j * np.pi * np.outer(frequencies, column)) for column in rows.T)
    power: npt.NDArray[np.float64] = np.abs(first @ second.T) ** 2 / len(rows)
    return power


def radial_spectrum(x: npt.ArrayLike, size: SupportsIndex = 64) -> RadialSpectrum:
    """Average the periodogram over rings: what a set of blue noise is judged by.

    Parameters
    ----------
    x : array_like, shape (n, 2)
        Points in [0, 1]; to judge a method, average over several sets.
    size : int
        Rings of width 1 around the radii 1 to `size`.

    Returns
    -------
    RadialSpectrum
        Frequency, power and anisotropy of each ring (Ulichney 1987).

    Raises
    ------
    ValueError
        As `periodogram`.

    Examples
    --------
    Jittered points have little power below the frequency of their grid:

    >>> import numpy as np
    >>> from evenlight import points, quality
    >>> spectrum = quality.radial_spectrum(points.Stratified(2, n=1024).random(1024))
    >>> bool(spectrum.power[:8].mean() < 0.2), bool(0.8 < spectrum.power[40:].mean() < 1.2)
    (True, True)
    """
    power = periodogram(x, size)
    most = len(power) // 2
    axis = np.arange(-most, most + 1)
    radius = np.hypot(axis[:, None], axis[None, :])
    ring = np.rint(radius).astype(np.int64)
    used = (ring >= 1) & (ring <= most)
    ring, radius, power = ring[used] - 1, radius[used], power[used]
    count = np.bincount(ring, minlength=most)
    mean = np.bincount(ring, power, most) / count
    # k and −k have the same power: half of the frequencies are repetitions
    squares = np.bincount(ring, (power - mean[ring]) ** 2, most) / (count - 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        anisotropy = 10 * np.log10(squares / mean**2)
    return RadialSpectrum(np.bincount(ring, radius, most) / count, mean, anisotropy)


def pair_correlation(x: npt.ArrayLike, bins: SupportsIndex = 64, *, most: float | None = None) -> PairCorrelation:
    """Estimate the pair correlation of points in the plane, on the torus.

    Parameters
    ----------
    x : array_like, shape (n, 2)
        At least two points in [0, 1].
    bins : int
        The number of intervals of distances.
    most : float, optional
        The largest distance, at most 1/2; by default 5 / √n, or 1/2 if that is less.

    Returns
    -------
    PairCorrelation
        Distances, and pairs in units of what independent points have: 1 everywhere for these, 0 at small distances for
        points that keep theirs.

    Raises
    ------
    ValueError
        If the points are not in the unit square, or an argument has no meaning.

    Notes
    -----
    By SciPy's k-d tree. The expected number of pairs is exact: n (n − 1) π (r₁² − r₀²) / 2.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import points, quality
    >>> correlation = quality.pair_correlation(points.Independent(2, seed=1).points(0, 4096), 8)
    >>> bool(np.abs(correlation.density - 1).max() < 0.2)
    True
    """
    rows, count = _in_plane(x), int(bins.__index__())
    n = len(rows)
    if n < 2 or count < 1:
        raise ValueError("pairs need at least two points, and one interval of distances")
    largest = min(5 / n**0.5, 0.5) if most is None else float(most)
    if not 0 < largest <= 0.5:
        raise ValueError(f"most must be in (0, 0.5], not {largest}")
    edges = np.linspace(0, largest, count + 1)
    tree = _torus(rows)
    # all ordered pairs up to each distance, the n pairs of a point with itself included
    within = tree.count_neighbors(tree, edges)
    within[0] = n
    expected = n * (n - 1) * np.pi * np.diff(edges**2)
    return PairCorrelation((edges[1:] + edges[:-1]) / 2, np.diff(within) / expected)


def _torus(rows: npt.NDArray[np.float64]) -> Any:
    # the stubs of SciPy know no size of a box
    build: Any = cKDTree
    return build(rows % 1.0, boxsize=1.0)


def _checked(x: npt.ArrayLike) -> npt.NDArray[np.float64]:
    rows = as_rows(x)
    if not ((rows >= 0) & (rows <= 1)).all():
        raise ValueError("all numbers must be in [0, 1]")
    return rows


def _in_plane(x: npt.ArrayLike) -> npt.NDArray[np.float64]:
    rows = _checked(x)
    if rows.shape[1] != 2:
        raise ValueError(f"points must be in the plane, shape (n, 2), not {rows.shape}")
    return rows
