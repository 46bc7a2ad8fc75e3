"""Genz's fifth family: a ridge in every coordinate."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzContinuous"]


class GenzContinuous(Problem):
    """exp(-sum a_j |x_j - w_j|)."""

    name = "genz_continuous"
    kind = "kink"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 20.4) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        sides = np.expm1(-self._a * self._w) + np.expm1(-self._a * (1 - self._w))
        self.exact = float(np.prod(-sides / self._a))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.exp(-np.abs(x - self._w) @ self._a))
