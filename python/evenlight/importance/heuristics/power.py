"""The power heuristic: sharper shares, for when one proposal is much better than the others."""

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["weights"]


def weights(expected: Array) -> Array:
    """(n_j q_j)^2 / sum of (n_k q_k)^2 (E. Veach and L. J. Guibas, SIGGRAPH 1995)."""
    scaled = expected / expected.max(axis=1, keepdims=True)
    return np.asarray(scaled**2 / (scaled**2).sum(axis=1, keepdims=True))
