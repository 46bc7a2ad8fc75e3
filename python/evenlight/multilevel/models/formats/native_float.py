"""The formats NumPy computes in: half, single and double precision. Real arithmetic, measurable costs."""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from .arithmetic import Array

__all__ = ["NativeFloat"]

_TYPES: dict[int, Any] = {16: np.float16, 32: np.float32, 64: np.float64}


class NativeFloat:
    """IEEE 754 numbers of 16, 32 or 64 bits.

    Parameters
    ----------
    bits : {16, 32, 64}
        Of a number. Most processors compute those of 16 bits by way of 32, one operation at a time.

    Raises
    ------
    ValueError
        If it is another number.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import NativeFloat
    >>> NativeFloat(16).number(np.array([1.0001, 1.001]))
    array([1.   , 1.001], dtype=float16)
    """

    emulated = False

    def __init__(self, bits: SupportsIndex) -> None:
        if bits not in _TYPES:
            raise ValueError(f"bits must be one of {', '.join(map(str, _TYPES))}, not {bits}")
        self.bits = int(bits)
        self.name = f"float{self.bits}"
        self._type = _TYPES[self.bits]

    def number(self, x: Any) -> Array:
        """The nearest numbers of the format."""
        return np.asarray(x, self._type)

    def add(self, a: Array, b: Array) -> Array:
        """The processor's sums."""
        return np.asarray(a + b)

    def multiply(self, a: Array, b: Array) -> Array:
        """The processor's products."""
        return np.asarray(a * b)

    def double(self, a: Array) -> NDArray[np.float64]:
        """The same numbers."""
        return a.astype(np.float64)
