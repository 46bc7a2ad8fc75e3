"""What a sort is: an order of states in which neighbors are alike, and how it matches points."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenlight import _core

__all__ = ["Array", "Indices", "Sort", "along_curve"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class Sort(NamedTuple):
    """A way to put states in order, and points with them.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.smc import SORTS
    >>> SORTS["coordinate"].order(np.array([[0.3], [0.1], [0.2]])).tolist()
    [1, 2, 0]
    """

    order: Callable[[Array], Indices]
    """From states, shape (n, d), to the n indices that sort them."""
    keys: Callable[[int], int]
    """How many first coordinates of points belong to the sort of states of d coordinates."""
    sorts_points: bool = False
    """Whether points are sorted by these just as states are; if not, their number stands for them."""


def along_curve(states: Array) -> Indices:
    """The order of states along Hilbert's curve through their cloud; of one coordinate, the ascending order."""
    return _core.cloud_order(np.ascontiguousarray(states)).astype(np.intp, copy=False)
