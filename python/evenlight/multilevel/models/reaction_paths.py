"""Markov chains of chemical reactions in continuous time: tau-leaping on ever finer grids, up to the exact chain."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .reactions.exact_simulation import coupled_exactly, exactly
from .reactions.gene_transcription import gene_transcription
from .reactions.network import ReactionNetwork
from .reactions.streams import Streams
from .reactions.tau_leaping import coupled_leaps, leaps
from .row_blocks import row_blocks

__all__ = ["ReactionPaths"]

Array = NDArray[np.float64]

_ROWS = 2048  # paths that step together: the arrays of a step fit a second-level cache
_PILOT = 16  # exact paths that say what one costs


class ReactionPaths(LevelSampler):
    """E quantity(X_T) of a reaction network; level l leaps on a grid of first_steps * refinement^l time steps.

    Parameters
    ----------
    network : ReactionNetwork, optional
        `gene_transcription` by default.
    quantity : callable, optional
        From counts at the end, shape (S, n), to values, shape (n,); the last species by default.
    horizon : float
        The time at the end.
    first_steps, refinement : int
        Of the grid.
    exact_level : int, optional
        If given, this level couples the exact chain with leaping on the grid of the level below, and is the last:
        estimates have no bias. 0 is exact simulation alone.

    Raises
    ------
    ValueError
        If a number is too small, or `quantity` returns another shape.

    Notes
    -----
    The two columns of `u` are the key of a path's own stream of random numbers (`Streams`); evenly spread points are
    of no use. Cost: one unit per random number. The variance of level differences falls as the time step does.

    Reference: D. F. Anderson and D. J. Higham, Multiscale Model. Simul. 10(1), 146-179 (2012).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import ReactionNetwork, ReactionPaths
    >>> decay = ReactionNetwork([[-1]], lambda x: (x[0],), [1000])
    >>> model = ReactionPaths(decay, exact_level=2)  # the mean is 1000 / e
    >>> sums = [model.sample(level, np.random.default_rng(1).random((500, 2))).difference.mean() for level in range(3)]
    >>> bool(abs(sum(sums) - 1000 / np.e) < 4.0)
    True
    """

    keyed = True

    def __init__(
        self,
        network: ReactionNetwork | None = None,
        quantity: Callable[[Array], Any] | None = None,
        *,
        horizon: float = 1.0,
        first_steps: SupportsIndex = 8,
        refinement: SupportsIndex = 4,
        exact_level: SupportsIndex | None = None,
    ) -> None:
        if not 0.0 < horizon < np.inf:
            raise ValueError(f"horizon must be above 0 and finite, not {horizon}")
        self.network = gene_transcription() if network is None else network
        self.horizon = float(horizon)
        self.first_steps = integer("first_steps", first_steps, 1)
        self.refinement = integer("refinement", refinement, 2)
        self.max_level = None if exact_level is None else integer("exact_level", exact_level, 0)
        self.exact = exact_level is not None
        self.name = f"{self.network.name} {'leaping' if exact_level is None else 'exact'}"
        self._quantity = quantity

    def steps(self, level: int) -> int:
        """Time steps of the fine grid of a level that leaps."""
        return self.first_steps * int(self.refinement ** integer("level", level, 0))

    def dims(self, level: int) -> int:
        """The key of a path."""
        return 2

    def cost(self, level: int) -> float:
        """Random numbers of a pair of paths: of exact ones what a few paths take on average."""
        if level == self.max_level:
            return self._exact_cost
        return float(self.network.reactions * self.steps(level) * (2 if level else 1))

    def sample(self, level: int, u: Array) -> Coupled:
        """The quantity of the fine path and of the coarse one."""
        keys = np.asarray(u, np.float64)
        if keys.ndim != 2 or keys.shape[1] != 2:
            raise ValueError(f"u must have shape (n, 2), not {keys.shape}")
        if self.max_level is not None and level > self.max_level:
            raise ValueError(f"level must be at most {self.max_level}, where the chain is exact, not {level}")
        fine, coarse, cost = np.empty(len(keys)), np.zeros(len(keys)), 0.0
        for rows in row_blocks(len(keys), 1, numbers=_ROWS):
            counts, partner, taken = self._pairs(level, keys[rows])
            fine[rows] = self._values(counts)
            if level:
                coarse[rows] = self._values(partner)
            cost += taken
        return Coupled(fine, coarse, cost)

    def _pairs(self, level: int, keys: Array) -> tuple[Array, Array, float]:
        """Counts of both paths, and what they took."""
        streams, n = Streams(keys), len(keys)
        if level == self.max_level:
            if level == 0:
                counts, events = exactly(self.network, streams, n, self.horizon)
                return counts, counts, 2.0 * float(events.sum())
            steps = self.steps(level - 1)
            counts, partner, events = coupled_exactly(self.network, streams, n, steps, self.horizon)
            return counts, partner, 2.0 * (float(events.sum()) + n * steps)
        taken = n * self.cost(level)
        if level == 0:
            counts = leaps(self.network, streams, n, self.steps(0), self.horizon)
            return counts, counts, taken
        grids = self.steps(level), self.steps(level - 1)
        return *coupled_leaps(self.network, streams, n, grids, self.horizon), taken

    def _values(self, counts: Array) -> Array:
        values = np.asarray(counts[-1] if self._quantity is None else self._quantity(counts), np.float64)
        if values.shape != counts.shape[1:]:
            raise ValueError(f"quantity must return shape {counts.shape[1:]}, not {values.shape}")
        return values

    @cached_property
    def _exact_cost(self) -> float:
        level = self.max_level or 0
        keys = np.random.default_rng(0).random((_PILOT, 2))
        return self._pairs(level, keys)[2] / _PILOT
