"""How fast mixed differences fall in two directions, and what they are for pairs of levels that were not sampled."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenlight.multilevel.decay import LEAST, MISFIT, Rates, relative_errors
from evenlight.multilevel.level import LevelRow

__all__ = ["Pair", "Plane", "fit_plane", "fit_planes"]

Array = NDArray[np.float64]
Pair: TypeAlias = tuple[int, int]

_CLASSES = ((True, False), (False, True), (False, False))  # i = 0, j = 0, both above: differences of three kinds


class Plane(NamedTuple):
    """Powers of 2 in both directions: K 2^(-r i - s j), with a K for i = 0, one for j = 0 and one for all others."""

    rates: Array
    """(r, s) for each quantity, shape (2, quantities)."""
    heights: Array
    """log2 of the three K, shape (3, quantities)."""

    def at(self, i: Any, j: Any) -> Array:
        """The value at pairs of levels, shape (..., quantities); infinite at (0, 0), of which it says nothing."""
        i, j = np.asarray(i)[..., np.newaxis], np.asarray(j)[..., np.newaxis]
        height = np.where(i == 0, np.where(j == 0, np.inf, self.heights[0]), np.where(j == 0, *self.heights[1:]))
        return np.asarray(2.0 ** (height - self.rates[0] * i - self.rates[1] * j))


def fit_planes(rows: Sequence[LevelRow]) -> tuple[Plane, Plane, tuple[Rates, Rates]]:
    """Of absolute means and of variances, and the slowest rates of both directions."""
    costs = fit_plane(rows, np.array([[row.cost] for row in rows]), np.zeros((len(rows), 1)), -math.inf)
    sizes = [np.abs([np.atleast_1d(getattr(row, name)) for row in rows]) for name in ("mean", "variance")]
    errors = [relative_errors(rows, name) for name in ("mean", "variance")]
    means, variances = (fit_plane(rows, *part, LEAST) for part in zip(sizes, errors, strict=True))
    both = zip(means.rates.min(axis=1), variances.rates.min(axis=1), -costs.rates[:, 0], strict=True)
    first, second = (Rates(*map(float, rates)) for rates in both)
    return means, variances, (first, second)


def fit_plane(rows: Sequence[LevelRow], values: Array, errors: Array, least: float) -> Plane:
    """The plane through log2 of values, shape (pairs, quantities), by least squares weighted by relative errors."""
    pairs = np.array([row.level for row in rows])
    kinds = np.array([[(i == 0, j == 0) == kind for kind in _CLASSES] for i, j in pairs], np.float64)
    fits = [_fit(pairs, kinds, *columns, least) for columns in zip(values.T, errors.T, strict=True)]
    return Plane(*(np.stack(parts, axis=-1) for parts in zip(*fits, strict=True)))


def _fit(pairs: Array, kinds: Array, values: Array, errors: Array, least: float) -> Iterable[Array]:
    known = (kinds.sum(axis=1) > 0) & (values > 0) & np.isfinite(errors)
    weights = 1.0 / np.hypot(errors[known] / math.log(2), MISFIT)
    pairs, kinds, y = pairs[known], kinds[known], np.log2(values[known])
    design = np.concatenate([-pairs, kinds], axis=1)
    rates = np.maximum(np.linalg.lstsq(design * weights[:, np.newaxis], y * weights)[0][:2], least)
    counts = weights**2 @ kinds
    with np.errstate(invalid="ignore", divide="ignore"):
        heights = (weights**2 * (y + pairs @ rates)) @ kinds / counts
    return rates, np.where(counts > 0, heights, -np.inf)
