"""The cutoff heuristic: proposals with little to say at a point are not heard."""

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["weights"]

_CUTOFF = 0.1


def weights(expected: Array) -> Array:
    """The balance heuristic among the proposals of at least a tenth of the largest (E. Veach, thesis, 1997)."""
    kept = np.where(expected >= _CUTOFF * expected.max(axis=1, keepdims=True), expected, 0.0)
    return np.asarray(kept / kept.sum(axis=1, keepdims=True))
