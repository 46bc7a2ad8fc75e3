"""Systematic resampling: a random shift of an even grid. The default; usually varies least (Carpenter et al. 1999)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, ancestors_below

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Of the numbers (i + u) / m, ⌈m s - u⌉ are below s: every particle is drawn ⌊m w⌋ or ⌈m w⌉ times."""
    sums = np.cumsum(weights)
    sums *= count / sums[-1]
    sums -= u[0]
    below = np.ceil(sums, out=sums).astype(np.intp)
    below[-1] = count
    return ancestors_below(np.minimum(below, count, out=below))
