"""The maximum heuristic: every point belongs to the proposal of the largest expected density."""

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["weights"]


def weights(expected: Array) -> Array:
    """1 for the largest n_j q_j, the first of equals, else 0 (E. Veach, thesis, 1997)."""
    chosen = np.zeros_like(expected)
    np.put_along_axis(chosen, expected.argmax(axis=1)[:, np.newaxis], 1.0, axis=1)
    return chosen
