"""Genz's second family: a peak in every coordinate."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzProductPeak"]


class GenzProductPeak(Problem):
    """Product of 1 / (a_j^-2 + (x_j - w_j)^2)."""

    name = "genz_product_peak"
    kind = "smooth"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 7.25) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        angles = np.arctan(self._a * (1 - self._w)) + np.arctan(self._a * self._w)
        self.exact = float(np.prod(self._a * angles))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.prod(1 / (self._a**-2 + (x - self._w) ** 2), axis=1))
