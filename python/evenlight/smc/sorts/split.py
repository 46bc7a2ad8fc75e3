"""By halving: by the first coordinate into two halves, each by the second into two, and round again to single states.

The split sort of P. L'Ecuyer, D. Munger, C. Lécot and B. Tuffin, "Sorting methods and convergence rates for
Array-RQMC", Math. Comput. Simul. 143, 191-201 (2018). Like "batch", without a choice of group sizes.
"""

from __future__ import annotations

import numpy as np

from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    n, d = states.shape
    order = np.arange(n)
    group = np.zeros(n, np.intp)
    for level in range(max(1, (n - 1).bit_length())):
        order = order[np.lexsort((states[order, level % d], group))]
        group = np.arange(n) * 2 ** (level + 1) // n
    return order


SORT = Sort(_order, lambda d: d, sorts_points=True)
