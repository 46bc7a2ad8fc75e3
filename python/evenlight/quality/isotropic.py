"""The isotropic discrepancy: the largest error over all convex sets of the square."""

import operator
from typing import Literal, NamedTuple, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows
from .worst_set import Kind, WorstSetDiscrepancy

__all__ = ["IsotropicDiscrepancy", "isotropic_discrepancy"]


class ConvexSet(NamedTuple):
    """What is known besides the number itself."""

    kind: Kind
    vertices: tuple[tuple[float, float], ...]
    closed: bool
    lower: float
    upper: float


class IsotropicDiscrepancy(WorstSetDiscrepancy[ConvexSet]):
    """An isotropic discrepancy or a bound: a number that says which.

    Attributes
    ----------
    value : float
        The number itself.
    kind : {"exact", "lower", "upper"}
        Whether the isotropic discrepancy is, is at least, or is at most this.
    lower, upper : float
        Between these the isotropic discrepancy certainly is, up to rounding.
    vertices : ndarray, shape (k, 2)
        The corners of the worst convex polygon that is known, counterclockwise; its discrepancy is `lower`. One or two
        are a point or a line segment.
    closed : bool
        Whether that polygon is closed and has too many points; otherwise it is open and has too few.

    Examples
    --------
    >>> from evenlight import quality
    >>> worst = quality.isotropic_discrepancy([[0.25, 0.25], [0.5, 0.5], [0.75, 0.75]], sectors=8)
    >>> float(worst), worst.kind, worst.vertices.tolist()
    (1.0, 'exact', [[0.25, 0.25], [0.75, 0.75]])
    """

    @property
    def lower(self) -> float:
        """The isotropic discrepancy is at least this."""
        return self.evidence.lower

    @property
    def upper(self) -> float:
        """The isotropic discrepancy is at most this."""
        return self.evidence.upper

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """The corners of the worst polygon that is known."""
        return np.array(self.evidence.vertices)


def isotropic_discrepancy(
    x: npt.ArrayLike,
    bound: Literal["lower", "upper"] = "lower",
    *,
    sectors: SupportsIndex = 32,
    workers: SupportsIndex = 1,
) -> IsotropicDiscrepancy:
    """Find the largest |points inside / n − area| over all convex sets in the unit square.

    Parameters
    ----------
    x : array_like, shape (n, 2)
        At most 1,024 points in [0, 1]².
    bound : {"lower", "upper"}
        Which one the number is where they do not meet; both are there in any case.
    sectors : int
        Into how many parts the directions of sides are divided, a power of 2 from 8 to 4,096. More bring the bounds
        together: time and memory grow like sectors².
    workers : int
        Threads; they change no bit.

    Returns
    -------
    IsotropicDiscrepancy
        A number in (0, 1] that says whether it is exact or a bound, and which polygon attains the lower one.

    Raises
    ------
    ValueError
        If the points are not in two dimensions, a number is not in [0, 1], there are too many points, or sectors for
        that many, or an argument has no meaning.

    Notes
    -----
    The worst set with too many points is the hull of some of them, and is found exactly in O(n³) (after Eppstein,
    Overmars, Rote and Woeginger 1992). The worst set with too few is between two bounds: O(n³ sectors²) or less, as
    far as it may be worse than the other; measured, 0.5 s for n = 32 and 3 s for n = 64 with 32 sectors. At most
    2^26 pieces of polygons, some n² sectors² / 8, are kept, of 8 bytes each. The number is exact where the
    bounds meet, which needs that too many points are the worse.

    At least the star discrepancy D, and at most a multiple of its root (H. Niederreiter, *Random Number Generation and
    Quasi-Monte Carlo Methods*, 1992, chapter 2).

    Examples
    --------
    >>> from evenlight import points, quality
    >>> x = points.Sobol(2, scramble="none").points(0, 16)
    >>> found = quality.isotropic_discrepancy(x)
    >>> quality.star_discrepancy(x) <= found.lower <= found.upper
    True
    """
    if bound not in ("lower", "upper"):
        raise ValueError(f"unknown bound {bound!r}; known: lower, upper")
    if operator.index(sectors) < 1 or operator.index(workers) < 1:
        raise ValueError(f"sectors and workers must be at least 1, not {sectors} and {workers}")
    found = _core.isotropic_discrepancy(as_rows(x), operator.index(sectors), operator.index(workers))
    lower, vertices, closed, upper = found
    kind = "exact" if lower == upper else bound
    polygon = tuple((x, y) for x, y in vertices)
    value = upper if kind == "upper" else lower
    return IsotropicDiscrepancy(value, ConvexSet(kind, polygon, closed, lower, upper))
