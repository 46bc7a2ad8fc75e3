"""Stratified resampling: one number in each of m equal intervals. Never worse than multinomial (Kitagawa 1996)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, ancestors_below

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Of the numbers (i + u_i) / m, ⌊m s⌋ or one more are below s: which of both a single comparison tells."""
    sums = np.cumsum(weights)
    sums *= count / sums[-1]
    below = sums.astype(np.intp)
    np.minimum(below, count - 1, out=below)
    below += below + u.take(below) < sums
    below[-1] = count
    return ancestors_below(below)
