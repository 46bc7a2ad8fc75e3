"""Sums that merge: count, mean, and sums of squared and cubed deviations from it, without cancellation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from evenlight import intervals

__all__ = ["Moments"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Moments:
    """What a mean, its standard error and its skewness need to know of independent values.

    Merging is that of B. P. Welford, Technometrics 4(3), 419-420 (1962), for blocks of values: T. F. Chan,
    G. H. Golub and R. J. LeVeque, Am. Stat. 37(3), 242-247 (1983); third sums: P. Pébay, SAND2008-6212.
    """

    count: int
    mean: Array
    second: Array
    """Sum of squared deviations from the mean."""
    third: Array
    """Sum of cubed deviations from the mean."""

    @classmethod
    def of(cls, values: Array) -> Moments:
        """The moments of values along their first axis."""
        values = np.asarray(values, np.float64)
        if len(values) == 0:
            zero = np.zeros(values.shape[1:])
            return cls(0, zero, zero, zero)
        mean = values.mean(axis=0)
        from_mean = values - mean
        squares = from_mean * from_mean
        return cls(len(values), mean, squares.sum(axis=0), (squares * from_mean).sum(axis=0))

    def merge(self, other: Moments) -> Moments:
        """The moments of both sets of values together."""
        if not self.count or not other.count:
            return other if not self.count else self
        a, b = self.count, other.count
        n = a + b
        step = other.mean - self.mean
        second = self.second + other.second + step**2 * (a * b / n)
        third = self.third + other.third + step**3 * (a * b * (a - b) / n**2)
        third = third + 3 * step * (a * other.second - b * self.second) / n
        return Moments(n, self.mean + step * (b / n), second, third)

    @property
    def standard_error(self) -> Array:
        """Of the mean; NaN for fewer than two values."""
        if self.count < 2:
            return np.full_like(self.mean, np.nan)
        return np.asarray(np.sqrt(self.second / (self.count - 1) / self.count))

    @property
    def degrees(self) -> float:
        """Of freedom of the standard error."""
        return self.count - 1.0

    @property
    def skewness(self) -> Array:
        """Of the values; 0 where nothing varies."""
        return intervals.skewness(self.second / self.count, self.third / self.count)
