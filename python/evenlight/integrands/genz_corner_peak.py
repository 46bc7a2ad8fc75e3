"""Genz's third family: a peak in a corner."""

from __future__ import annotations

import math

import numpy as np
from scipy import integrate

from .problem import Array, Problem, genz_parameters

__all__ = ["GenzCornerPeak"]


class GenzCornerPeak(Problem):
    """(1 + sum a_j x_j)^-(d + 1).

    The usual sum over corners cancels; ours is one-dimensional, over t, of e^-t prod (1 - e^(-a_j t)) / a_j.
    """

    name = "genz_corner_peak"
    kind = "smooth"
    cite = "A. Genz, in Tools, Methods and Languages for Scientific and Engineering Computation (1984), 81-94"

    def __init__(self, d: int, difficulty: float = 1.85) -> None:
        super().__init__(d)
        self._a, self._w = genz_parameters(d, difficulty)
        inner = lambda t: math.exp(-t) * float(np.prod(-np.expm1(-self._a * t) / self._a))  # noqa: E731
        integral = integrate.quad(inner, 0, 30, epsabs=0, epsrel=1e-13, limit=200)[0]
        integral += integrate.quad(inner, 30, math.inf, epsabs=1e-300, epsrel=1e-10)[0]
        self.exact = integral / math.factorial(d)

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray((1 + x @ self._a) ** -(self.d + 1.0))
