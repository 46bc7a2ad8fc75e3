"""An unbounded corner: no finite variation, but a finite variance."""

from __future__ import annotations

import numpy as np

from .problem import Array, Problem

__all__ = ["SingularCorner"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite


class SingularCorner(Problem):
    """Product of (1 - A) x_j^-A with A = 0.4, which is square-integrable since A < 1/2."""

    name = "singular_corner"
    kind = "singular"
    cite = "A. B. Owen, ACM Trans. Model. Comput. Simul. 16(4), 304-330 (2006)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = 1.0

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray(np.prod(0.6 * np.maximum(x, _LEAST) ** -0.4, axis=1))
