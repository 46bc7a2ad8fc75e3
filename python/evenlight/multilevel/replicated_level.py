"""The state of one level driven by evenly spread points: running means of independent randomizations."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.integrand import rows_per_block
from evenlight.multilevel.level import LevelRow, level_points, plain
from evenlight.multilevel.level_sampler import draw
from evenlight.points import Engine

__all__ = ["ReplicatedLevel"]

Array = NDArray[np.float64]


class ReplicatedLevel:
    """The first n points of R randomizations, on one level."""

    def __init__(self, sampler: Any, level: Any, points: Engine, seed: int, replicates: int) -> None:
        self.level = level
        self._sampler = sampler
        self._replicates = replicates
        self._points = level_points(points, sampler.dims(level), level, seed)
        self._means: Array = np.zeros((2, replicates))
        self.n = 0
        """Points of each randomization."""
        self.cost = 0.0
        """Of all of them."""

    def extend(self, n: int) -> None:
        """Evaluate points until there are n in each randomization."""
        block = rows_per_block(int(self._points.d) * 4, self._replicates)
        while self.n < n:
            self._add(self.n, min(n, self.n + block))

    def _add(self, start: int, stop: int) -> None:
        u = self._points.points(start, stop, replicates=self._replicates).reshape(-1, int(self._points.d))
        coupled = draw(self._sampler, self.level, u)
        both = np.stack([coupled.difference, coupled.fine])
        means = both.reshape(2, self._replicates, stop - start, *both.shape[2:]).mean(axis=2)
        self._means = means if start == 0 else self._means + (means - self._means) * ((stop - start) / stop)
        self.n = stop
        self.cost += coupled.cost

    @property
    def mean(self) -> Array:
        """Of the difference."""
        return np.asarray(self._means[0].mean(axis=0))

    @property
    def variance(self) -> Array:
        """Of the mean of the difference, from the spread of the randomizations."""
        return np.asarray(self._means[0].var(axis=0, ddof=1) / self._replicates)

    def row(self, below: ReplicatedLevel | None) -> LevelRow:
        """The level as a line of a table; `below` is the next coarser one."""
        n = self.n * self._replicates
        fine = self._means[1]
        row = LevelRow(
            self.level,
            n,
            plain(self.mean),
            plain(self.variance * n),
            self.cost / n,
            fine_mean=plain(fine.mean(axis=0)),
            fine_variance=plain(fine.var(axis=0, ddof=1) / self._replicates * n),
        )
        return row if below is None else row.compared(below.row(None))
