"""Multinomial resampling: independent draws. The easiest to analyze, and the noisiest (Gordon et al. 1993)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, ancestors_by_search

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """Sorted, so that the search runs through memory in order."""
    return ancestors_by_search(weights, np.sort(u[:count]))
