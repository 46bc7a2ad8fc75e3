"""Stratified resampling: one number in each of m equal intervals. Never worse than multinomial (Kitagawa 1996)."""

from __future__ import annotations

import numpy as np

from .inverse_cdf import Array, Indices, drawn

__all__ = ["ancestors"]


def ancestors(weights: Array, u: Array, count: int) -> Indices:
    """By the numbers (i + u_i) / m."""
    return drawn(weights, (np.arange(float(count)) + u[:count]) / count)
