"""A function with a kink askew to all coordinates."""

from __future__ import annotations

import numpy as np
from scipy import special

from .problem import Array, Problem

__all__ = ["Kink"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite


class Kink(Problem):
    """max(w - 1, 0), where w is the sum of normal quantiles over the root of d."""

    name = "kink"
    kind = "kink"
    cite = "P. L'Ecuyer, M. K. Nakayama, A. B. Owen and B. Tuffin, Winter Simulation Conference (2023)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = float(np.exp(-0.5) / np.sqrt(2 * np.pi) - special.ndtr(-1.0))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        w = special.ndtri(np.maximum(x, _LEAST)).sum(axis=1) / np.sqrt(self.d)
        return np.asarray(np.maximum(w - 1.0, 0.0))
