"""Distributions of a random level, and the best ones for sums without bias."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

__all__ = ["LevelDistribution", "best_for_single_term", "best_for_sum"]

Array = NDArray[np.float64]

_DEEPEST = 62


@dataclass(frozen=True)
class LevelDistribution:
    """A random level N: the probabilities P(N >= l) of the first levels, and a constant factor from then on.

    Parameters
    ----------
    head : sequence of float
        P(N >= 0) = 1, P(N >= 1), …: above 0 and not increasing.
    ratio : float
        P(N >= l + 1) / P(N >= l) beyond the head, at least 0 and below 1; 0 if the head's last level is the last of
        all.

    Raises
    ------
    ValueError
        If a probability is not as above.

    Examples
    --------
    >>> from evenlight.multilevel import LevelDistribution
    >>> geometric = LevelDistribution((1.0,), 0.25)
    >>> geometric.survival([0, 1, 2])
    array([1.    , 0.25  , 0.0625])
    >>> geometric.mass([0, 1, 2])
    array([0.75    , 0.1875  , 0.046875])
    >>> geometric.draw([0.7, 0.8, 0.99])
    array([0, 1, 3])
    """

    head: tuple[float, ...]
    ratio: float

    def __post_init__(self) -> None:
        """Refuse what is no distribution."""
        head = np.asarray(self.head, np.float64)
        if head.ndim != 1 or len(head) == 0 or head[0] != 1.0 or np.any(np.diff(head) > 0) or not head[-1] > 0:
            raise ValueError(f"head must be P(N >= 0) = 1, P(N >= 1), …, not increasing and above 0, not {self.head}")
        if not 0.0 <= self.ratio < 1.0:
            raise ValueError(f"ratio must be at least 0 and below 1, not {self.ratio}")

    @classmethod
    def geometric(cls, rate: float) -> Self:
        """P(N >= l) = 2^(-rate l)."""
        return cls((1.0,), 2.0**-rate)

    @property
    def rate(self) -> float:
        """The r of P(N >= l) ~ 2^(-r l); infinite if there is a last level."""
        return -math.log2(self.ratio) if self.ratio else math.inf

    def survival(self, levels: Any) -> Array:
        """P(N >= l) for each of the levels."""
        levels = np.asarray(levels, np.int64)
        last = len(self.head) - 1
        inside = np.asarray(self.head)[np.minimum(levels, last)]
        return np.asarray(inside * np.float64(self.ratio) ** np.maximum(levels - last, 0))

    def mass(self, levels: Any) -> Array:
        """P(N = l) for each of the levels."""
        levels = np.asarray(levels, np.int64)
        return np.asarray(self.survival(levels) - self.survival(levels + 1))

    def draw(self, u: Any) -> NDArray[np.int64]:
        """Levels by the inverse of the distribution function, at uniform numbers in [0, 1)."""
        beyond = self.survival(np.arange(1, len(self.head) + _DEEPEST))
        return np.asarray(np.searchsorted(-beyond, np.asarray(u) - 1.0, side="right"))


def best_for_single_term(squares: Array, costs: Array, mean: float, tail: float) -> LevelDistribution:
    """The distribution that minimizes variance times cost of Δ_N / P(N = l).

    With the second moments a_l of the differences, the variance is Σ a_l / p_l - μ² and the cost Σ C_l p_l, which gives
    p_l ∝ √(a_l / (C_l variance + μ² cost)), here by fixed-point iteration. `tail` is the rate beyond the last level;
    0 if there is nothing beyond.
    """
    squares = np.maximum(squares, 1e-300)
    mass = np.sqrt(squares / costs)
    for _ in range(50):
        mass = mass / mass.sum()
        variance = max(float((squares / mass).sum()) - mean**2, 0.0)
        mass = np.sqrt(squares / (costs * variance + mean**2 * float(costs @ mass)))
    ratio = 2.0**-tail if tail else 0.0
    mass[-1] /= 1.0 - ratio  # the last one stands for all beyond, which fall by the ratio
    survival = np.cumsum(mass[::-1])[::-1]
    return LevelDistribution(tuple((survival / survival[0]).tolist()), ratio)


def best_for_sum(terms: Array, costs: Array, tail: float) -> LevelDistribution:
    """The distribution that minimizes variance times cost of Σ_{l <= N} Δ_l / P(N >= l).

    The variance is Σ ν_l / P(N >= l), with the squared mean taken from ν_0, and the cost Σ t_l P(N >= l). Without
    order, P(N >= l) ∝ √(ν_l / t_l); with it, levels are pooled where that would increase (Rhee and Glynn 2015,
    theorem 3).
    """
    fitted = optimize.isotonic_regression(np.maximum(terms, 0.0) / costs, weights=costs, increasing=False).x
    fitted = np.maximum(fitted, 1e-300 + 1e-16 * fitted[0])
    return LevelDistribution(tuple(np.sqrt(fitted / fitted[0]).tolist()), 2.0**-tail if tail else 0.0)
