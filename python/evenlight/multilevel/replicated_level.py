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
        self._judge()

    def _judge(self) -> None:
        mean, fine_mean = self._means.mean(axis=1)
        variance, fine_variance = self._means.var(axis=1, ddof=1) / self._replicates
        n = self.n * self._replicates
        self.variance = variance
        """Of the mean of the difference, from the spread of the randomizations."""
        self.row = LevelRow(
            self.level,
            n,
            plain(mean),
            plain(variance * n),
            self.cost / n,
            fine_mean=plain(fine_mean),
            fine_variance=plain(fine_variance * n),
        )
        """The level as a line of a table, without its consistency."""
