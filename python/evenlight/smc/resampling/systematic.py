"""Systematic resampling: a random shift of an even grid. The default; usually varies least (Carpenter et al. 1999)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, drawn

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """By the numbers (i + u) / m: every particle is drawn ⌊m w⌋ or ⌈m w⌉ times."""
    return drawn(weights, (np.arange(float(count)) + u[0]) / count)
