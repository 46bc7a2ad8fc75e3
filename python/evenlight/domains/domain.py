"""What a domain is: a map of the unit cube that keeps even points even, and a volume."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Domain"]

Array = NDArray[np.float64]


class Domain:
    """A set, or a probability measure, that uniform points are mapped to."""

    name: ClassVar[str]
    """Its name in the registry."""

    d: int
    """How many uniform numbers make a point."""
    volume: float
    """What the mean of a function is multiplied by: the volume of a set, 1 for a probability measure."""

    def map(self, u: Array) -> Array:
        """Points, one in each row, from uniform ones of shape (n, d)."""
        raise NotImplementedError
