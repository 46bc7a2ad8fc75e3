"""Keister's integral of physics: an oscillation that dies away in all directions."""

from __future__ import annotations

import numpy as np
from scipy import special

from .problem import Array, Problem

__all__ = ["Keister"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite


class Keister(Problem):
    """cos |x| exp(-|x|^2) over R^d, brought to the unit cube by normal quantiles."""

    name = "keister"
    kind = "smooth"
    cite = "B. D. Keister, Computers in Physics 10, 119-122 (1996)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = float(np.pi ** (d / 2) * special.hyp1f1(d / 2, 0.5, -0.25))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        radius = np.sqrt((special.ndtri(np.maximum(x, _LEAST)) ** 2).sum(axis=1) / 2)
        return np.asarray(np.pi ** (self.d / 2) * np.cos(radius))
