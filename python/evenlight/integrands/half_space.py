"""The indicator of a half space: a flat boundary askew to all coordinates."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from .problem import Array, Problem

__all__ = ["HalfSpace"]


class HalfSpace(Problem):
    """1 where the coordinates add up to at most 9/20 of their number, else 0; exact by rational arithmetic."""

    name = "half_space"
    kind = "jump"
    cite = "P. Hall, Biometrika 19, 240-244 (1927); J. O. Irwin, Biometrika 19, 225-239 (1927)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        limit = Fraction(9 * d, 20)
        self._limit = float(limit)
        terms = ((-1) ** k * math.comb(d, k) * (limit - k) ** d for k in range(math.floor(limit) + 1))
        self.exact = float(sum(terms, Fraction(0)) / math.factorial(d))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray((x.sum(axis=1) <= self._limit).astype(np.float64))
