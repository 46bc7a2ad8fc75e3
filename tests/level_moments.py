"""Means and variances of level differences from independent numbers, for the tests of models."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def moments(model: Any, levels: int, n: int, seed: int) -> tuple[Array, Array]:
    """Of levels 0, …, levels - 1, from n samples each."""
    rng = np.random.default_rng(seed)
    differences = [model.sample(level, rng.random((n, model.dims(level)))).difference for level in range(levels)]
    return np.array([d.mean() for d in differences]), np.array([d.var(ddof=1) for d in differences])


def exponent(variances: Array, first: int = 2) -> float:
    """The rate at which they fall per level, in powers of 2, fitted from level `first` on."""
    levels = np.arange(first, len(variances))
    return float(-np.polyfit(levels, np.log2(variances[first:]), 1)[0])
