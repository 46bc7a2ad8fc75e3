"""What models with two directions of refinement share: the mixed difference of four values."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.level_sampler import Coupled, MultiIndexSampler

__all__ = ["MixedDifference"]

Array = NDArray[np.float64]


class MixedDifference(MultiIndexSampler):
    """P(l_1, l_2) against P(l_1 - 1, l_2) + P(l_1, l_2 - 1) - P(l_1 - 1, l_2 - 1) from the same uniform numbers.

    A model says `dims`, `value` and `value_cost`. Reference: A.-L. Haji-Ali, F. Nobile and R. Tempone, "Multi-index
    Monte Carlo: when sparsity meets sampling", Numer. Math. 132(4), 767-806 (2016).
    """

    keyed = False

    def value(self, level: tuple[int, int], u: Array) -> Array:
        """P of one pair of levels, shape (n,), from the numbers of a pair at least as fine."""
        raise NotImplementedError

    def value_cost(self, level: tuple[int, int]) -> float:
        """Of one value of P."""
        raise NotImplementedError

    def cost(self, level: tuple[int, int]) -> float:
        """Of all values of P in a mixed difference."""
        return self.value_cost(level) + sum(self.value_cost(term) for term, _ in _terms(level))

    def sample(self, level: tuple[int, int], u: Array) -> Coupled:
        """P of the pair of levels, and what is subtracted from it."""
        pair = (integer("level", level[0], 0), integer("level", level[1], 0))
        if any(most is not None and own > most for own, most in zip(pair, self.max_level, strict=True)):
            raise ValueError(f"level must be at most {self.max_level}, not {pair}")
        numbers = np.asarray(u, np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != self.dims(pair):
            raise ValueError(f"u must have shape (n, {self.dims(pair)}) on level {pair}, not {numbers.shape}")
        coarse = np.zeros(len(numbers))
        for term, sign in _terms(pair):
            coarse += sign * self.value(term, numbers)
        return Coupled(self.value(pair, numbers), coarse, len(numbers) * self.cost(pair))


def _terms(level: tuple[int, int]) -> list[tuple[tuple[int, int], float]]:
    """The coarser pairs that exist, with their signs."""
    first, second = level
    coarser = [((first - 1, second), 1.0), ((first, second - 1), 1.0), ((first - 1, second - 1), -1.0)]
    return [(pair, sign) for pair, sign in coarser if min(pair) >= 0]
