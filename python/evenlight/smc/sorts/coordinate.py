"""By the first coordinate alone: for states of one dimension, or where the first coordinate decides most."""

from __future__ import annotations

from .ascending import ascending
from .sort import Array, Indices, Sort

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    return ascending(states[:, 0])


SORT = Sort(_order, lambda d: 1)
