"""Along Hilbert's curve through the cloud of states: the default of filters (Gerber and Chopin 2015).

Coordinates are standardized and squeezed into the unit cube, so that no particle far away makes all others one cell.
States of one dimension come in ascending order.
"""

from __future__ import annotations

import numpy as np

from evenlight import _core

from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    return _core.cloud_order(np.ascontiguousarray(states)).astype(np.intp, copy=False)


SORT = Sort(_order, lambda d: 1)
