"""Medians that merge: what the median of independent replicates needs to know of them, which is all of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Medians"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Medians:
    """The median of values along their first axis, in the place of the mean that `Moments` have."""

    values: Array

    def merge(self, other: Medians) -> Medians:
        """The median of both sets of values together."""
        return Medians(np.concatenate([self.values, other.values]))

    @property
    def count(self) -> int:
        """The number of values."""
        return len(self.values)

    @property
    def mean(self) -> Array:
        """The median."""
        return np.asarray(np.median(self.values, axis=0))

    @property
    def standard_error(self) -> Array:
        """What it is if the values are normal, with their spread from the median absolute deviation."""
        if self.count < 2:
            return np.full(self.values.shape[1:], np.nan)
        spread = 1.482602 * np.median(np.abs(self.values - self.mean), axis=0)
        return np.asarray(math.sqrt(math.pi / 2 / (self.count - 1)) * spread)

    @property
    def degrees(self) -> float:
        """Of freedom of the error: the median absolute deviation has 0.37 times the efficiency of the standard one."""
        return max(1.0, 0.37 * (self.count - 1))
