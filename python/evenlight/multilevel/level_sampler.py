"""Level samplers: the one interface between coupled models and the methods above them.

A model of levels 0, 1, 2, … simulates one quantity P_0, P_1, P_2, … ever more finely. For a block of uniform numbers
a level sampler gives the fine and the coarse value of the same simulation: P_l and P_(l-1) from the same randomness,
whose difference has the smaller variance the higher the level.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Coupled", "Ladder", "LevelSampler", "MultiIndexSampler", "draw"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Coupled:
    """A block of coupled values, row by row from the same rows of uniform numbers.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import Coupled
    >>> Coupled(fine=np.array([1.0, 2.5]), coarse=np.array([1.0, 2.0]), cost=6.0).difference
    array([0. , 0.5])
    """

    fine: Array
    """P_l, shape (n,), or (n, k) for k quantities at once."""
    coarse: Array
    """P_(l-1), of the shape of `fine`; zeros on level 0."""
    cost: float
    """Of the whole block, fine and coarse, in the model's own units, such as time steps."""

    @property
    def difference(self) -> Array:
        """Fine minus coarse."""
        return self.fine - self.coarse


class LevelSampler(Protocol):
    """What every model of levels does. Inherit from it for the defaults, or have all of its names.

    Laws: `sample` is a pure function of its arguments, row by row: row i of its values depends on row i of `u` alone.
    `u` is only lent, the next block is written over it; copy what is to be kept.
    The mean of `coarse` on level l is that of `fine` on level l - 1; otherwise the sum over levels is biased.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import Coupled, LevelSampler
    >>> class Midpoints(LevelSampler):  # the integral of exp(x y) over y by 2^l midpoints, averaged over x
    ...     name = "midpoints"
    ...     def dims(self, level):
    ...         return 1
    ...     def cost(self, level):
    ...         return 2**level + (2 ** (level - 1) if level else 0)
    ...     def rule(self, x, n):
    ...         return np.exp(x * (np.arange(n) + 0.5) / n).mean(axis=1)
    ...     def sample(self, level, u):
    ...         fine = self.rule(u, 2**level)
    ...         coarse = self.rule(u, 2 ** (level - 1)) if level else np.zeros(len(u))
    ...         return Coupled(fine, coarse, len(u) * self.cost(level))
    >>> Midpoints().sample(3, np.array([[0.5]])).difference.round(4)
    array([0.0006])
    """

    name: str
    """In messages and reports."""
    max_level: int | None = None
    """The finest level; None if there is no end to them."""
    exact: bool = False
    """True if the finest level is the quantity itself, so that the sum over all levels has no bias."""
    keyed: bool = False
    """True if the columns of `u` are the key of a generator (a simulation that takes no fixed number of random numbers)
    and not numbers that the values depend on: then evenly spread points are of no use, and methods that are driven by
    them refuse."""

    def dims(self, level: int) -> int:
        """Uniform numbers that one sample of this level takes, at least 1; columns in order of importance."""
        ...

    def sample(self, level: int, u: Array) -> Coupled:
        """Values at uniform numbers in [0, 1), shape (n, dims(level))."""
        ...

    def cost(self, level: int) -> float:
        """Expected cost of one sample of this level, fine and coarse, in the units of `Coupled.cost`."""
        ...


class Ladder(Protocol):
    """A level sampler that can run one simulation on all levels at once besides; the coupled sum of `debias` asks it.

    It costs what all levels up to the given one cost: cost(level) + cost(level - 2) + …, as `cost` is of pairs.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import Ladder
    >>> class Exponential(Ladder):  # partial sums of the series of exp(u)
    ...     def ladder(self, level, u):
    ...         terms = u ** np.arange(level + 1) / np.cumprod([1.0, *range(1, level + 1)])
    ...         return np.cumsum(terms, axis=1)
    >>> Exponential().ladder(2, np.array([[0.5]]))
    array([[1.   , 1.5  , 1.625]])
    """

    def ladder(self, level: int, u: Array) -> Array:
        """P_0, …, P_level of the same simulation, shape (n, level + 1), at numbers of shape (n, dims(level))."""
        ...


class MultiIndexSampler(Protocol):
    """A model with two directions of refinement: the level is a pair (l_1, l_2).

    `fine` is P at (l_1, l_2), `coarse` is P(l_1 - 1, l_2) + P(l_1, l_2 - 1) - P(l_1 - 1, l_2 - 1), so that the
    difference is the mixed one; terms with a negative index are 0. Otherwise as `LevelSampler`.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import Coupled, MultiIndexSampler
    >>> class Product(MultiIndexSampler):  # P(l_1, l_2) = u (1 - 2^-l_1) (1 - 2^-l_2)
    ...     name = "product"
    ...     def dims(self, level):
    ...         return 1
    ...     def cost(self, level):
    ...         return 2.0 ** sum(level)
    ...     def value(self, u, first, second):
    ...         return u[:, 0] * (1 - 0.5 ** max(first, 0)) * (1 - 0.5 ** max(second, 0))
    ...     def sample(self, level, u):
    ...         i, j = level
    ...         coarse = self.value(u, i - 1, j) + self.value(u, i, j - 1) - self.value(u, i - 1, j - 1)
    ...         return Coupled(self.value(u, i, j), coarse, len(u) * self.cost(level))
    >>> Product().sample((1, 2), np.array([[0.5]])).difference
    array([0.0625])
    """

    name: str
    max_level: tuple[int | None, int | None] = (None, None)
    exact: bool = False
    """True if the finest level of every direction that has one is that of the quantity itself."""
    keyed: bool = False

    def dims(self, level: tuple[int, int]) -> int:
        """Uniform numbers that one sample of this pair of levels takes."""
        ...

    def sample(self, level: tuple[int, int], u: Array) -> Coupled:
        """Values at uniform numbers in [0, 1), shape (n, dims(level))."""
        ...

    def cost(self, level: tuple[int, int]) -> float:
        """Expected cost of one sample of this pair of levels, all of its terms."""
        ...


def draw(sampler: Any, level: Any, u: Array) -> Coupled:
    """A block of a sampler, checked: what is wrong with it is said with the sampler's name and its level."""
    where = f"sampler {sampler.name!r} on level {level}"
    coupled = sampler.sample(level, u)
    fine, coarse = (np.asarray(values, np.float64) for values in (coupled.fine, coupled.coarse))
    if fine.ndim not in (1, 2) or len(fine) != len(u) or coarse.shape != fine.shape:
        expected = f"fine and coarse of one shape ({len(u)},) or ({len(u)}, k)"
        raise ValueError(f"{where} must return {expected}, not {fine.shape} and {coarse.shape}")
    if not (np.isfinite(fine).all() and np.isfinite(coarse).all()):
        finite = (np.isfinite(fine) & np.isfinite(coarse)).reshape(len(u), -1).all(axis=1)
        row = int(np.argmin(finite))
        raise ValueError(f"{where} is {fine[row].tolist()} and {coarse[row].tolist()} at row {row} of a block")
    if not (math.isfinite(coupled.cost) and coupled.cost > 0):
        raise ValueError(f"{where} must say a cost above 0, not {coupled.cost}")
    return Coupled(fine, coarse, float(coupled.cost))
