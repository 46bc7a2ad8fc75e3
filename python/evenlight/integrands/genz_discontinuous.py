"""Genz's sixth family: a cliff in two coordinates."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzDiscontinuous"]


class GenzDiscontinuous(Problem):
    """exp(sum a_j x_j) where x_1 < w_1 and x_2 < w_2, else 0."""

    name = "genz_discontinuous"
    kind = "jump"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 4.3) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        ends = np.where(np.arange(d) < 2, self._w, 1.0)
        self.exact = float(np.prod(np.expm1(self._a * ends) / self._a))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        inside = (x[:, :2] < self._w[:2]).all(axis=1)
        return np.where(inside, np.exp(x @ self._a), 0.0)
