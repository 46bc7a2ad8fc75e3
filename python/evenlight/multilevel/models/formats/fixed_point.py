"""Fixed point: whole multiples of one step, as on programmable gate arrays. Emulated; for very few bits."""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer

from .arithmetic import Array

__all__ = ["FixedPoint"]


class FixedPoint:
    """Two's complement numbers of so many bits from -limit to below limit; too large ones become the largest.

    Parameters
    ----------
    bits : int
        From 2 to 52, the sign's included.
    limit : float
        Above 0; the step is limit / 2^(bits - 1).

    Raises
    ------
    ValueError
        If either is not as above.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import FixedPoint
    >>> FixedPoint(3).number(np.array([-2.0, 0.3, 0.4, 2.0]))
    array([-1.  ,  0.25,  0.5 ,  0.75])
    """

    emulated = True

    def __init__(self, bits: SupportsIndex, limit: float = 1.0) -> None:
        self.bits = integer("bits", bits, 2)
        if self.bits > 52 or not 0.0 < limit < np.inf:
            raise ValueError(f"bits must be at most 52 and limit above 0, not {bits} and {limit}")
        self.name = f"fixed{self.bits}"
        self.limit = float(limit)
        self.step = self.limit / 2 ** (self.bits - 1)

    def number(self, x: Any) -> Array:
        """The nearest multiples of the step; of two as near the even one."""
        steps = np.rint(np.asarray(x, np.float64) / self.step)
        return np.asarray(np.clip(steps, -(2.0 ** (self.bits - 1)), 2.0 ** (self.bits - 1) - 1.0) * self.step)

    def add(self, a: Array, b: Array) -> Array:
        """Exact but for numbers that are too large."""
        return self.number(a + b)

    def multiply(self, a: Array, b: Array) -> Array:
        """Rounded once."""
        return self.number(a * b)

    def double(self, a: Array) -> NDArray[np.float64]:
        """The same numbers."""
        return np.asarray(a, np.float64)
