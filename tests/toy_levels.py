"""Exact toy hierarchies: level samplers whose means, variances and costs are known."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import special

from evenlight.multilevel import Coupled, Ladder, LevelSampler, MultiIndexSampler

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


class ProductLevels(MultiIndexSampler):
    """Mixed differences with the mean 2^(-alpha (i + j)), the variance 2^(-beta (i + j)) and the cost 2^(i + j)."""

    name = "product levels"

    def __init__(self, alpha: float, beta: float) -> None:
        self._alpha, self._beta = alpha, beta
        self.exact_value = (1.0 / (1.0 - 2.0**-alpha)) ** 2

    def dims(self, level: tuple[int, int]) -> int:
        """A number for the difference and one for the coarse values."""
        return 2

    def cost(self, level: tuple[int, int]) -> float:
        """Doubles in both directions."""
        return float(2.0 ** sum(level))

    def mean(self, i: int, j: int) -> float:
        """Of the value at a pair of levels."""
        mean = self.exact_value * (1.0 - 2.0 ** (-self._alpha * (i + 1))) * (1.0 - 2.0 ** (-self._alpha * (j + 1)))
        return float(mean)

    def sample(self, level: tuple[int, int], u: Array) -> Coupled:
        """Normal numbers of known mean and variance."""
        z = special.ndtri(np.maximum(u, 2.0**-60))
        i, j = level
        difference = 2.0 ** (-self._alpha * (i + j)) + 2.0 ** (-0.5 * self._beta * (i + j)) * z[:, 0]
        below = self.mean(i - 1, j) + self.mean(i, j - 1) - self.mean(i - 1, j - 1)
        coarse = below + z[:, 1] * (level != (0, 0))
        return Coupled(coarse + difference, coarse, len(u) * self.cost(level))


class BothRefined(LevelSampler):
    """The same limit by levels that refine both directions together: l stands for the pairs with max(i, j) = l."""

    name = "both refined"

    def __init__(self, alpha: float, beta: float) -> None:
        self._alpha, self._beta = alpha, beta
        self._pairs = ProductLevels(alpha, beta)
        self.exact_value = self._pairs.exact_value

    def dims(self, level: int) -> int:
        """A number for the difference and one for the coarse value."""
        return 2

    def cost(self, level: int) -> float:
        """That of the finest pair."""
        return float(4.0**level)

    def sample(self, level: int, u: Array) -> Coupled:
        """Normal numbers: the differences of all pairs of the level, which are independent, together."""
        z = special.ndtri(np.maximum(u, 2.0**-60))
        pairs = [(i, j) for i in range(level + 1) for j in range(level + 1) if max(i, j) == level]
        variance = sum(2.0 ** (-self._beta * (i + j)) for i, j in pairs)
        mean = self._pairs.mean(level, level) - (below := self._pairs.mean(level - 1, level - 1))
        coarse = below + z[:, 1] if level else np.zeros(len(u))
        return Coupled(coarse + mean + np.sqrt(variance) * z[:, 0], coarse, len(u) * self.cost(level))


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
