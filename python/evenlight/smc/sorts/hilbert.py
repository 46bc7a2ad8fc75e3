"""Along Hilbert's curve: the default of filters for states of several dimensions (Gerber and Chopin 2015).

Coordinates are mapped to the unit cube by a logistic function of the standardized state, so that no particle far away
makes all others one cell.
"""

from __future__ import annotations

import numpy as np
from scipy import special

from evenlight.warp import hilbert_sort

from .ascending import ascending
from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    d = states.shape[1]
    if d == 1:
        return ascending(states[:, 0])
    spread = states.std(axis=0)
    standard = (states - states.mean(axis=0)) / np.where(spread > 0, spread, 1.0)
    cube = [[0.0] * d, [1.0] * d]
    return hilbert_sort(special.expit(standard), bounds=cube).astype(np.intp)


SORT = Sort(_order, lambda d: 1)
