"""Stratified resampling: one number in each of m equal intervals. Never worse than multinomial (Kitagawa 1996)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, ancestors_below, scaled_sums

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Of the numbers (i + u_i) / m, ⌊m s⌋ or one more are below s: which of both a single comparison tells."""
    sums = scaled_sums(weights, count)
    below = sums.astype(np.intp)
    np.minimum(below, count - 1, out=below)
    sums -= below
    below += sums > u.take(below)
    return ancestors_below(below)
