"""A function with a jump askew to all coordinates."""

from __future__ import annotations

import numpy as np
from scipy import special

from .problem import Array, Problem

__all__ = ["Jump"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite


class Jump(Problem):
    """1 where w >= 1, else 0; w is the sum of normal quantiles over the root of d."""

    name = "jump"
    kind = "jump"
    cite = "P. L'Ecuyer, M. K. Nakayama, A. B. Owen and B. Tuffin, Winter Simulation Conference (2023)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = float(special.ndtr(-1.0))

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        w = special.ndtri(np.maximum(x, _LEAST)).sum(axis=1) / np.sqrt(self.d)
        return np.asarray((w >= 1.0).astype(np.float64))
