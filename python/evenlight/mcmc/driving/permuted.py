"""Liao's proposal: the rows of any randomized point set in random order. For steps of many numbers, and any length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from evenlight.points.engine import Engine

from .protocol import Array, Driving, Stream

__all__ = ["Permuted"]


@dataclass(frozen=True)
class Permuted(Driving):
    """Rows of a randomized point set, each one step, in random order.

    Every replicate has a randomization and a permutation of its own. Balanced over the chain in each step's numbers,
    but not from step to step.

    Parameters
    ----------
    points : evenlight.points.Engine
        With as many dimensions as a step takes uniform numbers, and a randomization.

    Raises
    ------
    TypeError, ValueError
        If the points are none of ours, or not random.

    Notes
    -----
    A weakly completely uniformly distributed array [2]_ in the limit of n: means over Metropolis chains on finite
    spaces are known to converge (see `LFSR`). Memory: 8 n d bytes for each replicate.

    References
    ----------
    .. [1] J. G. Liao, "Variance reduction in Gibbs sampler using quasi random numbers", J. Comput. Graph. Stat. 7(3),
       253-266 (1998).
    .. [2] S. D. Tribble and A. B. Owen, "Construction of weakly CUD sequences for MCMC sampling", Electron. J. Stat. 2,
       634-660 (2008).

    Examples
    --------
    >>> from evenlight.mcmc import Permuted
    >>> from evenlight.points import Sobol
    >>> stream = Permuted(Sobol(2)).stream(dims=2, n=64, replicates=4, seed=1)
    >>> rows = stream(0, 64)[0]
    >>> sorted((rows[:, 1] * 64).astype(int)) == list(range(64))
    True
    """

    name: ClassVar[str] = "permuted"

    points: Any

    def __post_init__(self) -> None:
        if not isinstance(self.points, Engine):
            raise TypeError(f"points must be a sequence of evenlight.points, not {type(self.points).__name__}")
        if not self.points.is_random:
            raise ValueError(f"{self.points!r} is not random: choose a scramble other than 'none'")

    def length(self, dims: int) -> int | None:
        """As many steps as there are points."""
        del dims
        return self.points.n if self.points.finite else None

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """All rows of all replicates, at once."""
        if self.points.d != dims:
            raise ValueError(f"a step takes {dims} uniform numbers, {self.points!r} has {self.points.d} dimensions")
        rows = self.points.replicate(seed).points(0, n, replicates=replicates)
        for replicate, own in enumerate(rows):
            own[:] = own[np.random.default_rng([seed, replicate]).permutation(n)]

        def steps(start: int, stop: int) -> Array:
            return np.asarray(rows[:, start:stop])

        return steps
