"""Genz's fourth family: a bell."""

from __future__ import annotations

import numpy as np
from scipy import special

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzGaussian"]


class GenzGaussian(Problem):
    """exp(-sum a_j^2 (x_j - w_j)^2)."""

    name = "genz_gaussian"
    kind = "smooth"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 7.03) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        spread = special.erf(self._a * (1 - self._w)) + special.erf(self._a * self._w)
        self.exact = float(np.prod(np.sqrt(np.pi) / 2 / self._a * spread))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.exp(-(((x - self._w) * self._a) ** 2).sum(axis=1)))
