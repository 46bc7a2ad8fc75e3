"""What weights say about an estimate by importance sampling: how many they are worth, and how heavy their tail is."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["effective_sample_size", "tail_index"]


def effective_sample_size(weights: Any) -> float:
    """How many equal weights would vary as little: (sum of w)² / sum of w².

    Parameters
    ----------
    weights : array_like, shape (n,)
        Not negative; a common factor does not matter.

    Returns
    -------
    float
        From 1 to n.

    Notes
    -----
    A. Kong, *A note on importance sampling using standardized weights*, University of Chicago (1992).

    Examples
    --------
    >>> from evenlight.importance import effective_sample_size
    >>> effective_sample_size([1, 1, 1, 1, 0])
    4.0
    """
    w = _weights(weights)
    return float(w.sum() ** 2 / (w**2).sum())


def tail_index(weights: Any) -> float:
    """The shape k of the generalized Pareto distribution that the largest weights follow.

    Below 0.5 the variance of the weights is finite; above 0.7 an estimate and its error cannot be trusted.

    Parameters
    ----------
    weights : array_like, shape (n,)
        Not negative, at least 25 of them above 0; a common factor does not matter.

    Returns
    -------
    float
        k; -inf where the largest weights are all alike, NaN for too few of them.

    Notes
    -----
    The fit is ArviZ's, to the largest min(n / 5, 3 sqrt(n)) weights: A. Vehtari, D. Simpson, A. Gelman, Y. Yao and
    J. Gabry, "Pareto smoothed importance sampling", J. Mach. Learn. Res. 25(72) (2024).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import tail_index
    >>> u = (np.arange(100_000) + 0.5) / 100_000
    >>> round(tail_index(u**-0.4), 1)
    0.4
    """
    w = _weights(weights)
    size = int(min(0.2 * len(w), 3.0 * math.sqrt(len(w))))
    if size < 5:
        return math.nan
    least = np.partition(w, [-size - 1, -size * 3 // 4])[[-size - 1, -size * 3 // 4]]
    if least[1] - least[0] <= 1e-13 * w.max():
        return -math.inf  # a quarter of the largest, or more, are alike: nothing to fit
    return float(_array_stats().pareto_khat(w, chain_axis=None, r_eff=1, tail="right"))


def _array_stats() -> Any:
    from arviz_stats.base import array_stats  # here, for it takes as long as all of NumPy

    return array_stats


def _weights(weights: Any) -> Array:
    w = np.asarray(weights, np.float64)
    if w.ndim != 1 or not np.isfinite(w).all() or w.min(initial=0.0) < 0 or not w.any():
        raise ValueError("weights must be a list of finite numbers, none negative and not all 0")
    return w
