"""What a number format is for a simulation: how numbers get into it, and addition and multiplication rounded to it."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Arithmetic", "Array"]

Array = NDArray[Any]


class Arithmetic(Protocol):
    """Addition and multiplication in one format, on arrays.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import FixedPoint
    >>> eighths = FixedPoint(4)  # from -1 to 7 / 8
    >>> eighths.multiply(eighths.number(np.array([0.3, 0.6])), eighths.number(0.7))
    array([0.25, 0.5 ])
    """

    name: str
    bits: int
    """Of a number in memory."""
    emulated: bool
    """True if doubles are rounded to what the format has: slower than doubles, and no measure of its speed."""

    def number(self, x: Any) -> Array:
        """Doubles, rounded to the format."""
        ...

    def add(self, a: Array, b: Array) -> Array:
        """Rounded sums."""
        ...

    def multiply(self, a: Array, b: Array) -> Array:
        """Rounded products."""
        ...

    def double(self, a: Array) -> NDArray[np.float64]:
        """Numbers of the format as doubles, exactly."""
        ...
