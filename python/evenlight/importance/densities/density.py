"""What a density is: points from uniform numbers, and the logarithm of its value at points."""

from __future__ import annotations

from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["LEAST", "Array", "Density"]

Array = NDArray[np.float64]

LEAST = 2.0**-65
"""Instead of 0, which points may have: where normal quantiles would be infinite."""


class Density:
    """A probability density on R^d that can be drawn from."""

    name: ClassVar[str]
    """Its name in the registry."""

    d: int
    """The number of coordinates of a point."""
    uniforms: int
    """How many uniform numbers make a point."""

    def sample(self, u: Array) -> Array:
        """Points, shape (n, d), from uniform numbers in [0, 1), shape (n, uniforms)."""
        raise NotImplementedError

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density, shape (n,), at points of shape (n, d)."""
        raise NotImplementedError

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """The density that stands for a foreign object, or None if there is none."""
        return thing if isinstance(thing, cls) else None
