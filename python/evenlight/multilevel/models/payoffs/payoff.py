"""What a payoff is: from paths to discounted values, plainly or with a treatment that keeps coupled paths close."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.multilevel.models.option import Option
from evenlight.multilevel.models.path import Path

__all__ = ["Array", "Payoff"]

Array = NDArray[np.float64]


class Payoff:
    """A discounted payoff of paths of one asset.

    `plain` uses the values on the path's grid, which is what paths of strong order 1/2 deserve. `smooth` treats the
    path between grid points as a Brownian bridge, which restores the variance of Milstein's scheme. The mean of
    either is the same for a path on its own and for the same path as the coarse one of a pair.
    """

    name: ClassVar[str]
    """Its name in the registry."""
    cite: ClassVar[str]
    """Where its treatment was published."""
    takes_uniforms: ClassVar[bool] = False
    """True if `smooth` takes one more uniform number per step."""

    def __init__(self, option: Option) -> None:
        self.option = option

    def plain(self, path: Path) -> Array:
        """Values of paths, shape (n,), from their grid points."""
        raise NotImplementedError

    def smooth(self, path: Path) -> Array:
        """Values of paths, shape (n,), with what happens between grid points."""
        raise NotImplementedError

    def exact(self) -> float | None:
        """The price in continuous time, or None where there is no formula."""
        raise NotImplementedError
