"""A sum of smooth functions of single coordinates: the easiest there is."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem

__all__ = ["AdditiveExponential"]


class AdditiveExponential(Problem):
    """Mean of x_j exp(x_j) over j."""

    name = "additive_exponential"
    kind = "smooth"
    cite = "P. L'Ecuyer, M. K. Nakayama, A. B. Owen and B. Tuffin, Winter Simulation Conference (2023)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = 1.0

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray((x * np.exp(x)).mean(axis=1))
