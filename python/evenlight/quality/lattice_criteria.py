"""How good lattices and nets are: squared worst-case errors in weighted spaces of functions."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Literal, SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core

__all__ = ["digital_net_error", "lattice_error"]


def lattice_error(
    generator: Sequence[SupportsIndex],
    n: SupportsIndex,
    *,
    weights: Sequence[SupportsFloat] | None = None,
    space: Literal["sobolev", "korobov"] = "sobolev",
    smoothness: SupportsIndex = 2,
) -> float:
    """Return the squared worst-case error of a rank-1 lattice in a weighted space of functions.

    It is -1 plus the mean over the points of the product over the coordinates of 1 + γ_j ω(x_j).

    Parameters
    ----------
    generator : sequence of int
        The generating vector z: the points are k z / n modulo 1.
    n : int
        The number of points, at least 1.
    weights : sequence of float, optional
        The γ_j, one for each coordinate, not negative; 1 / j² by default.
    space : {"sobolev", "korobov"}
        "sobolev": the mean square over random shifts in the unanchored space of mixed first derivatives,
        ω = x² - x + 1/6. "korobov": the weighted P_α of periodic functions, ω the sum of exp(2πihx) / |h|^α.
    smoothness : {2, 4, 6}
        The α of "korobov".

    Returns
    -------
    float
        The squared error, with an absolute error of some 10^-16.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Exact, in time n d: measured, 2 nanoseconds times that.

    References: I. H. Sloan, F. Y. Kuo and S. Joe, SIAM J. Numer. Anal. 40, 1650-1665 (2002); I. H. Sloan and S. Joe,
    *Lattice methods for multiple integration* (1994).

    Examples
    --------
    >>> from evenlight.quality import lattice_error
    >>> round(lattice_error([1], 8) * 6 * 8**2, 9)
    1.0
    >>> lattice_error([1, 5], 8) < lattice_error([1, 1], 8)
    True
    """
    z, count = [operator.index(number) for number in generator], operator.index(n)
    gamma = _weights(weights, len(z))
    return _core.lattice_error(z, count, gamma, space, operator.index(smoothness))


def digital_net_error(x: npt.ArrayLike, *, weights: Sequence[SupportsFloat] | None = None) -> float:
    """Return the squared worst-case error of a digital net in base 2, averaged over digital shifts.

    Parameters
    ----------
    x : array_like of float, shape (n, d)
        The points before randomization, in [0, 1).
    weights : sequence of float, optional
        The γ_j, one for each coordinate, not negative; 1 / j² by default.

    Returns
    -------
    float
        The mean square over digital shifts in the unanchored Sobolev space of mixed first derivatives.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Exact, in time n d: measured, 2 nanoseconds times that. References: J. Dick and F. Pillichshammer, J. Complexity 21,
    149-195 (2005).

    Examples
    --------
    >>> from evenlight.points import Sobol
    >>> from evenlight.quality import digital_net_error
    >>> round(digital_net_error(Sobol(1, scramble="none").points(0, 8)) * 6 * 8**2, 9)
    1.0
    """
    rows = np.ascontiguousarray(x, dtype=np.float64)
    if rows.ndim != 2 or not rows.size:
        raise ValueError(f"x must have shape (n, d) with at least one point and coordinate, not {rows.shape}")
    if not ((rows >= 0) & (rows < 1)).all():
        raise ValueError("x must have numbers in [0, 1)")
    return _core.digital_net_error(rows, _weights(weights, rows.shape[1]))


def _weights(weights: Sequence[SupportsFloat] | None, dims: int) -> list[float]:
    if weights is None:
        return [1.0 / j**2 for j in range(1, dims + 1)]
    return [float(weight) for weight in weights]
