"""Genz's first family: a wave."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzOscillatory"]


class GenzOscillatory(Problem):
    """cos(2 pi w_1 + sum a_j x_j)."""

    name = "genz_oscillatory"
    kind = "smooth"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 9.0) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        wave = np.prod(np.expm1(1j * self._a) / (1j * self._a))
        self.exact = float((np.exp(2j * np.pi * self._w[0]) * wave).real)

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.cos(2 * np.pi * self._w[0] + x @ self._a))
