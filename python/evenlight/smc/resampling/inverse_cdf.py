"""Indices by inversion: which particle each of many ascending numbers draws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from evenlight import _core

__all__ = ["Array", "Indices", "drawn"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


def drawn(weights: Array, numbers: Array) -> Indices:
    """The particle into whose share of the weights each number falls; never one without weight. O(n + m)."""
    return _core.drawn_places(np.ascontiguousarray(weights, np.float64), numbers).astype(np.intp, copy=False)
