"""What a test integrand is: a function on the unit cube, and its integral."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Problem", "genz_parameters"]

Array = NDArray[np.float64]


class Problem:
    """A function of blocks of points (n, d) of the unit cube whose integral is known.

    Parameters
    ----------
    d : int
        The number of coordinates.
    """

    name: ClassVar[str]
    """Its name in the registry."""
    kind: ClassVar[str]
    """What stands in the way of fast rates: "smooth" (nothing), "kink", "jump", "singular" or "nowhere" continuous."""
    cite: ClassVar[str]
    """Where it was published."""
    least_dims: ClassVar[int] = 1

    exact: float
    """The integral, to 12 digits or better."""

    def __init__(self, d: int) -> None:
        if d < self.least_dims:
            raise ValueError(f"{self.name} has at least {self.least_dims} dimensions, not {d}")
        self.d = int(d)

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d), shape (n,)."""
        raise NotImplementedError

    def __repr__(self) -> str:
        """Name and dimensions."""
        return f"{type(self).__name__}({self.d})"


def genz_parameters(d: int, difficulty: float) -> tuple[Array, Array]:
    """Fixed parameters of Genz's families: slopes a that add up to the difficulty, and places w spread in (0, 1)."""
    falling = np.arange(d, 0, -1, dtype=np.float64) - 0.5
    places: Array = (np.arange(1, d + 1, dtype=np.float64) * 0.6180339887498949) % 1.0
    slopes: Array = np.asarray(difficulty * falling / falling.sum())
    return slopes, 0.1 + 0.8 * places
