"""In batches: by the first coordinate into n^(1/d) groups, each by the second into as many, and so on.

The multivariate batch sort of P. L'Ecuyer, D. Munger, C. Lécot and B. Tuffin, "Sorting methods and convergence rates
for Array-RQMC", Math. Comput. Simul. 143, 191-201 (2018). For few coordinates that matter alike.
"""

from __future__ import annotations

import numpy as np

from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    n, d = states.shape
    order = np.arange(n)
    group = np.zeros(n, np.intp)
    for j in range(d):
        order = order[np.lexsort((states[order, j], group))]
        if j < d - 1:
            group = _cut(group, round(n ** (1 / d)))
    return order


def _cut(group: Indices, parts: int) -> Indices:
    """Every group of neighbors in as many equal parts."""
    starts = np.flatnonzero(np.diff(group, prepend=-1))
    sizes = np.diff(starts, append=len(group))
    within = np.arange(len(group)) - np.repeat(starts, sizes)
    return np.asarray(group * parts + within * parts // np.repeat(sizes, sizes))


SORT = Sort(_order, lambda d: d, sorts_points=True)
