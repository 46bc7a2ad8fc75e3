"""Multinomial resampling: independent draws. The easiest to analyze, and the noisiest (Gordon et al. 1993)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, drawn

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """By the numbers themselves, in ascending order."""
    return drawn(weights, np.sort(u[:count]))
