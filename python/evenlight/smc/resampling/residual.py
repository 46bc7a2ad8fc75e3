"""Residual resampling: the whole parts of m w for sure, the rest by independent draws (Liu and Chen 1998)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, drawn

__all__ = ["ancestors"]

_ROUNDING = 1 + 1e-12  # 0.9999999999999999 is a whole number


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Every particle is drawn at least ⌊m w⌋ times."""
    expected = weights * (count / weights.sum())
    counts = np.floor(expected * _ROUNDING).astype(np.intp)
    left = count - int(counts.sum())
    if left > 0:
        rest = drawn(np.maximum(expected - counts, 0.0), np.sort(u[:left]))
        counts += np.bincount(rest, minlength=len(weights))
    return np.arange(len(weights)).repeat(counts)
