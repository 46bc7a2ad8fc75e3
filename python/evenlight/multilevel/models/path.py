"""A block of paths on a grid of times, and how a coarse one is filled in at the times of the fine one it is coupled to.

Arrays have time first: the operations of a step run along contiguous memory.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Path", "Refined"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Refined:
    """A path at the times of its driving increments, between which it is a Brownian bridge."""

    values: Array
    """Shape (m + 1, n)."""
    diffusion: Array
    """The coefficient of the bridge in each step, shape (m, n)."""
    step: float
    """Of time."""


@dataclass(frozen=True, eq=False)
class Path:
    """Paths of a scalar equation whose diffusion coefficient is `volatility` times the value."""

    values: Array
    """At equally spaced times, shape (steps + 1, n)."""
    increments: Array
    """Of the driving Brownian motion, shape (steps * ratio, n): a coarse path knows those of the fine one."""
    step: float
    """Of time, between values."""
    volatility: float
    uniforms: Array | None = None
    """One more uniform number per increment, for payoffs that ask for it."""

    @property
    def ratio(self) -> int:
        """Increments per step."""
        return len(self.increments) // (len(self.values) - 1)

    def refined(self) -> Refined:
        """The path at the times of its increments.

        With frozen coefficients a path within a step is the straight line plus a Brownian bridge, and the increments
        say which bridge (Giles 2008, equation 6): in law nothing changes, and fine and coarse path stay close.
        """
        steps, ratio = len(self.values) - 1, self.ratio
        start, stop = self.values[:-1], self.values[1:]
        diffusion = self.volatility * start
        if ratio == 1:
            return Refined(self.values, diffusion, self.step)
        values = np.empty((steps * ratio + 1, self.values.shape[1]))
        values[::ratio] = self.values
        motion = self.increments.reshape(steps, ratio, -1)
        whole = motion.sum(axis=1)
        partial = np.zeros_like(start)
        for part in range(1, ratio):
            share = part / ratio
            partial += motion[:, part - 1]
            values[part::ratio] = start + share * (stop - start) + diffusion * (partial - share * whole)
        return Refined(values, np.repeat(diffusion, ratio, axis=0), self.step / ratio)
