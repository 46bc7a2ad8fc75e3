"""Ancestors by inversion: how often each particle is drawn by uniform numbers in ascending order."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Indices", "ancestors_below", "ancestors_by_search", "scaled_sums"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


def ancestors_by_search(weights: Array, u: Array) -> Indices:
    """The first particle whose partial sum of weights exceeds each number, for any ascending numbers in [0, 1)."""
    sums = np.cumsum(weights)
    return np.asarray(np.searchsorted(sums, u * sums[-1], side="right").clip(max=len(weights) - 1))


def scaled_sums(weights: Array, count: int) -> Array:
    """Partial sums of weights, from where the last positive one is on exactly the count."""
    sums = np.cumsum(weights)
    sums /= sums[-1]
    sums *= count
    return sums


def ancestors_below(below: Indices) -> Indices:
    """The same from how many numbers are below each partial sum."""
    below[1:] -= below[:-1].copy()
    return np.arange(len(below)).repeat(below)
