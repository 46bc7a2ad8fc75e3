"""Systematic resampling: a random shift of an even grid. The default; usually varies least (Carpenter et al. 1999)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, ancestors_below, scaled_sums

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Of the numbers (i + u) / m, ⌊m s⌋ or one more are below s: every particle is drawn ⌊m w⌋ or ⌈m w⌉ times."""
    sums = scaled_sums(weights, count)
    below = sums.astype(np.intp)
    sums -= below
    below += sums > u[0]
    return ancestors_below(below)
