"""How fast means and variances of levels fall and costs grow: powers of 2 by a regression that knows its errors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenlight.multilevel.level import LevelRow

__all__ = ["LEAST", "MISFIT", "Rates", "given_rate", "measure_rates", "relative_errors", "remaining_bias"]

Array = NDArray[np.float64]

LEAST = 0.5
"""The least α and β that a regression may find (Giles 2015, section 3.4)."""
MISFIT = 0.25
"""Of log2: how far levels stray from a power, besides their statistical error."""
_PRIOR = 64.0  # the inverse variance of what is known of alpha before means are measured


class Rates(NamedTuple):
    """The exponents of the theorem on the cost of multilevel Monte Carlo.

    Examples
    --------
    >>> from evenlight.multilevel import Rates
    >>> Rates(alpha=1.0, beta=2.0, gamma=1.0).beta
    2.0
    """

    alpha: float
    """Means of differences fall as 2^(-α l)."""
    beta: float
    """Variances of differences fall as 2^(-β l)."""
    gamma: float
    """Costs grow as 2^(γ l)."""


def measure_rates(rows: Sequence[LevelRow], alpha: float | None, beta: float | None) -> Rates:
    """The rates from levels 1 on, whose differences are of two levels; α and β at least 1/2, or as given.

    Weights are inverse squared errors: those of the means and variances themselves, and a misfit of every level. So
    the noise of the finest levels, where samples are few, does not count as slow decay. Of several values the slowest
    counts.
    """
    used = [row for row in rows if row.level >= 1]
    levels = np.array([row.level for row in used], np.float64)
    means, variances, costs = (_columns(used, name) for name in ("mean", "variance", "cost"))
    if alpha is None:
        alpha = max(LEAST, -_slope(levels, np.abs(means), relative_errors(used, "mean")))
    if beta is None:
        beta = max(LEAST, -_slope(levels, variances, relative_errors(used, "variance")))
    return Rates(alpha, beta, gamma=_slope(levels, costs, np.zeros_like(costs)))


def remaining_bias(rows: Sequence[LevelRow], alpha: float | None, beta: float = math.inf) -> Array:
    """A bound on the sum of all means beyond the last level, from those of the last three (Giles 2015, section 3.4).

    A measured alpha is drawn towards 1, the weak order of most schemes, or towards β if that is less, as where payoffs
    jump: means of differences are mostly noise, their variances are known better. Where means of both signs are sure,
    they do not fall yet, and the largest of them counts as if it were the last.
    """
    used = [row for row in rows if row.level >= 1]
    means = _columns(used, "mean")
    errors = relative_errors(used, "mean")
    if alpha is None:
        levels = np.array([row.level for row in used], np.float64)
        alpha = max(LEAST, -_slope(levels, np.abs(means), errors, expected=min(1.0, beta)))
    sure = np.where(errors < 0.5, np.sign(means), 0.0)[-3:]
    turns = (sure.min(axis=0) < 0) & (sure.max(axis=0) > 0)
    distance = rows[-1].level - np.array([[row.level] for row in used[-3:]])
    last = np.abs(means[-3:]) * np.where(turns, 1.0, 2.0 ** (-alpha * distance))
    return np.asarray(last.max(axis=0) / (2.0**alpha - 1.0)).reshape(np.shape(rows[0].mean))


def relative_errors(rows: Sequence[LevelRow], name: str) -> Array:
    """Standard errors of the mean or the variance of each level over their values, shape (levels, quantities)."""
    n, variances = _columns(rows, "n"), _columns(rows, "variance")
    with np.errstate(invalid="ignore", divide="ignore"):
        if name == "mean":
            return np.asarray(np.sqrt(variances / n) / np.abs(_columns(rows, "mean")))
        kurtoses = _columns(rows, "kurtosis")
        spread = np.where(np.isfinite(kurtoses), np.maximum(kurtoses - 1.0, 2.0), 2.0)
        spread = np.maximum.accumulate(spread, axis=0)  # tails do not become lighter; few samples only do not show them
        return np.asarray(np.sqrt(spread / n) * np.ones_like(variances))


def _columns(rows: Sequence[LevelRow], name: str) -> Array:
    """Entries of all rows, shape (levels, quantities), or (levels, 1) where there is one for all quantities."""
    return np.array([getattr(row, name) for row in rows], np.float64).reshape(len(rows), -1 if rows else 1)


def given_rate(name: str, rate: float | None) -> float | None:
    """Return a rate that a caller knows, or raise a ValueError."""
    if rate is not None and not 0.0 < rate < math.inf:
        raise ValueError(f"{name} must be above 0, not {rate}")
    return rate


def _slope(levels: Array, values: Array, relative_errors: Array, expected: float | None = None) -> float:
    """The largest slope of log2 of a column of values in the level; 0 from one level."""
    slopes = [_one_slope(levels, *pair, expected) for pair in zip(values.T, relative_errors.T, strict=True)]
    return max(slopes, default=0.0)


def _one_slope(levels: Array, values: Array, relative_errors: Array, expected: float | None) -> float:
    known = (values > 0) & np.isfinite(values)
    if known.sum() < 2:
        return 0.0
    x, y = levels[known], np.log2(values[known])
    weights = 1.0 / ((relative_errors[known] / math.log(2)) ** 2 + MISFIT**2)
    x = x - (weights @ x) / weights.sum()
    information = float((weights * x) @ x)
    slope = float((weights * x) @ y) / information
    return slope if expected is None else (slope * information - expected * _PRIOR) / (information + _PRIOR)
