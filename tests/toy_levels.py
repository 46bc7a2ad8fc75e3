"""Exact toy hierarchies: level samplers whose means, variances and costs are known."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import special

from evenlight.multilevel import Coupled, Ladder, LevelSampler

Array = NDArray[np.float64]


class NormalLevels(LevelSampler):
    """Differences with the mean 2^(-alpha l) and the variance 2^(-beta l) at the cost 2^(gamma l)."""

    name = "normal levels"

    def __init__(self, alpha: float, beta: float, gamma: float = 1.0, mismatch: float = 0.0) -> None:
        self._alpha, self._beta, self._gamma, self._mismatch = alpha, beta, gamma, mismatch
        self.exact_value = 1.0 / (1.0 - 2.0**-alpha)

    def dims(self, level: int) -> int:
        """A number for the difference and one for the coarse value."""
        return 2

    def cost(self, level: int) -> float:
        """Grows at the rate gamma."""
        return float(2.0 ** (self._gamma * level))

    def sample(self, level: int, u: Array) -> Coupled:
        """Normal numbers of known mean and variance."""
        z = special.ndtri(np.maximum(u, 2.0**-60))
        difference = 2.0 ** (-self._alpha * level) + 2.0 ** (-0.5 * self._beta * level) * z[:, 0]
        below = (1.0 - 2.0 ** (-self._alpha * level)) * self.exact_value
        coarse = below + z[:, 1] + self._mismatch if level else np.zeros(len(u))
        return Coupled(coarse + difference, coarse, len(u) * self.cost(level))


class ExponentialSeries(LevelSampler, Ladder):
    """The partial sums of e = 1/0! + 1/1! + …, without any noise but that of a random level."""

    name = "series of e"

    def dims(self, level: int) -> int:
        """None is needed; one is the least."""
        return 1

    def cost(self, level: int) -> float:
        """The same on every level."""
        return 1.0

    def sample(self, level: int, u: Array) -> Coupled:
        """The same in every row."""
        values = np.cumsum([0.0] + [1.0 / math.factorial(term) for term in range(level + 1)])
        return Coupled(np.full(len(u), values[-1]), np.full(len(u), values[-2]), float(len(u)))

    def ladder(self, level: int, u: Array) -> Array:
        """The partial sums."""
        return np.tile(np.cumsum([1.0 / math.factorial(term) for term in range(level + 1)]), (len(u), 1))


class PowerOfUniform(LevelSampler):
    """E U^(1 + 2^-l) -> 1/2, smooth: what evenly spread points are good at; the difference is nearly linear in 2^-l."""

    name = "power of uniform"
    exact_value = 0.5

    def dims(self, level: int) -> int:
        """The number itself."""
        return 1

    def cost(self, level: int) -> float:
        """Doubles from level to level."""
        return 2.0**level

    def sample(self, level: int, u: Array) -> Coupled:
        """Both powers of the same number."""
        x = u[:, 0]
        coarse = x ** (1.0 + 2.0 ** (1 - level)) if level else np.zeros(len(u))
        return Coupled(x ** (1.0 + 2.0**-level), coarse, len(u) * self.cost(level))
