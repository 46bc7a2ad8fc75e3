"""By the first coordinate alone: for states of one dimension, or where the first coordinate decides most."""

from __future__ import annotations

from .sort import Array, Indices, Sort, along_curve

__all__ = ["SORT"]


def _order(states: Array) -> Indices:
    return along_curve(states[:, :1])


SORT = Sort(_order, lambda d: 1)
