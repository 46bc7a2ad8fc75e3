"""A function that is nowhere continuous: not Riemann-integrable, and unscrambled digital nets see just one side."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem

__all__ = ["DyadicRationals"]


class DyadicRationals(Problem):
    """1 where the first coordinate is a dyadic rational, of at most 32 binary digits, else 0.

    The rationals are countable, so that the integral is 0; fixed points with fewer than 2^32 rows are all among them.
    """

    name = "dyadic_rationals"
    kind = "nowhere"
    cite = "A. B. Owen, Monte Carlo theory, methods and examples, chapter 15"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = 0.0

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        scaled = x[:, 0] * 2.0**32
        return np.asarray((scaled == np.floor(scaled)).astype(np.float64))
