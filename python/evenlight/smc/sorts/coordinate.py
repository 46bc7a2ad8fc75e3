"""By the first coordinate alone: for states of one dimension, or where the first coordinate decides most."""

from __future__ import annotations

import numpy as np

from evenlight import _core

from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    return _core.cloud_order(np.ascontiguousarray(states[:, :1])).astype(np.intp, copy=False)


SORT = Sort(_order, lambda d: 1)
