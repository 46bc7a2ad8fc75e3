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
    The largest min(n / 5, 3 sqrt(n)) weights, as in A. Vehtari, D. Simpson, A. Gelman, Y. Yao and J. Gabry, "Pareto
    smoothed importance sampling", J. Mach. Learn. Res. 25(72) (2024); the fit is that of J. Zhang and M. A. Stephens,
    Technometrics 51(3), 316-325 (2009), with the prior of the former.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import tail_index
    >>> u = (np.arange(100_000) + 0.5) / 100_000
    >>> round(tail_index(u**-0.4), 1)
    0.4
    """
    w = np.sort(_weights(weights))
    size = int(min(0.2 * len(w), 3.0 * math.sqrt(len(w))))
    if size < 5:
        return math.nan
    excess = w[-size:] - w[-size - 1]
    excess = excess[excess > 1e-13 * w[-1]]
    if len(excess) < 5:
        return -math.inf
    k = _pareto_shape(excess)
    return (k * len(excess) + 5.0) / (len(excess) + 10.0)  # a prior of ten values around 0.5


def _pareto_shape(excess: Array) -> float:
    """Zhang and Stephens' estimate: a mean over profile likelihoods of theta = -k / scale."""
    n = len(excess)
    points = 30 + int(math.sqrt(n))
    quartile = excess[int(n / 4 + 0.5) - 1]
    theta = 1 / excess[-1] + (1 - np.sqrt(points / (np.arange(1, points + 1) - 0.5))) / (3 * quartile)
    k = np.log1p(-theta[:, np.newaxis] * excess).mean(axis=1)
    profile = n * (np.log(-theta / k) - k - 1)
    weights = np.exp(profile - profile.max())
    best = float((theta * weights).sum() / weights.sum())
    return float(np.log1p(-best * excess).mean())


def _weights(weights: Any) -> Array:
    w = np.asarray(weights, np.float64)
    if w.ndim != 1 or not np.isfinite(w).all() or w.min(initial=0.0) < 0 or not w.any():
        raise ValueError("weights must be a list of finite numbers, none negative and not all 0")
    return w
