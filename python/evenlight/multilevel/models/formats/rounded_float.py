"""Floating point with any significand, emulated by rounding doubles: bfloat16, and ladders in fine steps."""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer

from .arithmetic import Array

__all__ = ["RoundedFloat"]


class RoundedFloat:
    """Floating-point numbers whose significand has so many bits, the leading one included, and a double's exponent.

    Parameters
    ----------
    significand : int
        From 2 to 50. That of bfloat16 is 8, whose exponent is large enough for most simulations.
    bits : int, optional
        Of a number in memory; by default those of significand, sign and 8 bits of exponent.
    name : str, optional
        In reports.

    Raises
    ------
    ValueError
        If the significand is not as above.

    Notes
    -----
    Reference for the rounding in three operations: T. J. Dekker, Numer. Math. 18(3), 224-242 (1971).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import RoundedFloat
    >>> RoundedFloat(8).number(np.array([1.003, 1.005, 3e20]))
    array([1.00000000e+00, 1.00781250e+00, 2.99759591e+20])
    """

    emulated = True

    def __init__(self, significand: SupportsIndex, *, bits: int | None = None, name: str | None = None) -> None:
        self.significand = integer("significand", significand, 2)
        if self.significand > 50:
            raise ValueError(f"significand must be at most 50 bits, not {significand}")
        self.bits = self.significand + 8 if bits is None else bits
        self.name = f"significand{self.significand}" if name is None else name
        self._splitter = 2.0 ** (53 - self.significand) + 1.0

    def number(self, x: Any) -> Array:
        """The nearest numbers of the format."""
        scaled = np.asarray(x, np.float64) * self._splitter
        return np.asarray(scaled - (scaled - x))

    def add(self, a: Array, b: Array) -> Array:
        """Rounded once."""
        return self.number(a + b)

    def multiply(self, a: Array, b: Array) -> Array:
        """Rounded once: the double in between is exact for significands of up to 26 bits."""
        return self.number(a * b)

    def double(self, a: Array) -> NDArray[np.float64]:
        """The same numbers."""
        return np.asarray(a, np.float64)
