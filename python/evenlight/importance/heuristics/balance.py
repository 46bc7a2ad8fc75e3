"""The balance heuristic: shares in proportion to the expected densities; nearly the best there is in the worst case."""

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["weights"]


def weights(expected: Array) -> Array:
    """n_j q_j / sum of n_k q_k (E. Veach and L. J. Guibas, SIGGRAPH 1995)."""
    return np.asarray(expected / expected.sum(axis=1, keepdims=True))
