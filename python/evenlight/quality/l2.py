"""The L2 family: mean squares of local discrepancies, exactly, with SciPy's conventions or one for all."""

import math
import operator
from typing import Literal, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows

__all__ = ["discrepancy"]

Method = Literal["CD", "WD", "MD", "L2-star", "weighted-star", "SD", "PD", "ED"]
Convention = Literal["scipy", "squared", "root"]


def discrepancy(
    x: npt.ArrayLike,
    method: Method = "CD",
    *,
    convention: Convention = "scipy",
    weights: npt.ArrayLike | None = None,
    algorithm: Literal["auto", "pairs", "halves"] = "auto",
    workers: SupportsIndex = 1,
) -> float:
    """Compute a discrepancy of the L2 family.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1].
    method : str
        - "CD": centered, "WD": wrap-around, "MD": mixture, "L2-star": boxes from the origin, all as in
          `scipy.stats.qmc.discrepancy`;
        - "weighted-star": boxes from the origin in all projections (Sloan and Woźniakowski 1998);
        - "SD": symmetric (Hickernell 1998);
        - "PD": periodic, boxes anywhere on the torus (Lev 1995);
        - "ED": extreme, boxes anywhere (Morokoff and Caflisch 1994).
    convention : str
        "squared" gives the square of the discrepancy, "root" the discrepancy itself, which compares with integration
        errors. "scipy" does as SciPy: the root for "L2-star", the square for the others.
    weights : array_like, shape (d,), optional
        A projection counts as much as the product of its coordinates' weights, each at least 0; 1 by default. For "CD",
        "WD", "MD", "SD" and "weighted-star".
    algorithm : str
        "pairs": O(n² d); "halves": divide and conquer, O(n log^(d−1) n) (Heinrich 1996), faster for few coordinates and
        many points; "auto": whichever should be faster.
    workers : int
        Threads of "pairs"; they change no bit.

    Returns
    -------
    float
        The discrepancy or its square.

    Raises
    ------
    ValueError
        If a number is not in [0, 1], or an argument has no meaning.

    Examples
    --------
    >>> from scipy.stats import qmc
    >>> from evenlight import points, quality
    >>> x = points.Sobol(5).points(0, 256)
    >>> abs(quality.discrepancy(x) / qmc.discrepancy(x) - 1) < 1e-9
    True
    >>> abs(quality.discrepancy(x, convention="root") ** 2 / quality.discrepancy(x) - 1) < 1e-12
    True
    """
    if convention not in ("scipy", "squared", "root"):
        raise ValueError(f"unknown convention {convention!r}; known: scipy, squared, root")
    if operator.index(workers) < 1:
        raise ValueError(f"workers must be at least 1, not {workers}")
    each = None if weights is None else [float(weight) for weight in np.asarray(weights, dtype=np.float64).ravel()]
    squared = _core.l2_discrepancy(as_rows(x), method, each, algorithm, operator.index(workers))
    if convention == "root" or (convention == "scipy" and method == "L2-star"):
        return math.sqrt(max(squared, 0.0))
    return squared
