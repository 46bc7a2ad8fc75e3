"""A product of linear functions: all interactions, the high ones small."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem

__all__ = ["ProductLinear"]


class ProductLinear(Problem):
    """Product of (d - x_j) / (d - 1/2)."""

    name = "product_linear"
    kind = "smooth"
    cite = "P. L'Ecuyer, M. K. Nakayama, A. B. Owen and B. Tuffin, Winter Simulation Conference (2023)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = 1.0

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.prod((self.d - x) / (self.d - 0.5), axis=1))
