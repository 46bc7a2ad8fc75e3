"""Quantiles of the t statistic by resampling, for intervals that need not be symmetric."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["percentile_t"]

_RESAMPLES = 2000
_SEED = 1979  # any fixed number: the same replicates give the same interval


def percentile_t(replicates: NDArray[np.float64], level: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper quantile of (mean* - mean) / error* over resamples (P. Hall, Ann. Stat. 16, 927-953, 1988).

    Parameters
    ----------
    replicates : ndarray of float64, shape (R, ...)
        Independent and identically distributed values.
    level : float
        The probability between the two quantiles.

    Returns
    -------
    tuple of ndarray
        Of the shape of one replicate. Resamples without spread are left out.
    """
    count = len(replicates)
    rows = np.random.default_rng(_SEED).integers(0, count, (_RESAMPLES, count))
    drawn = replicates[rows]
    spread = drawn.std(axis=1, ddof=1) / np.sqrt(count)
    with np.errstate(invalid="ignore", divide="ignore"):
        t = np.where(spread > 0, (drawn.mean(axis=1) - replicates.mean(axis=0)) / spread, np.nan)
    if np.isnan(t).all(axis=0).any():
        t = np.where(np.isnan(t).all(axis=0), 0.0, t)
    low, high = np.nanquantile(t, [0.5 - 0.5 * level, 0.5 + 0.5 * level], axis=0)
    return low, high
