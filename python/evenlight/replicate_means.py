"""Means of an integrand over each of several independent randomizations of a point set; they grow row by row."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.integrand import Integrand, rows_per_block

__all__ = ["ReplicateMeans"]


class ReplicateMeans:
    """The running means of R replicates, all at the same number of rows.

    Parameters
    ----------
    integrand : Integrand
        What to average.
    points : evenlight.points.Engine
        Its replicates 0 to R - 1 are used.
    replicates : int
        R, at least 2.
    """

    def __init__(self, integrand: Integrand, points: Any, replicates: int) -> None:
        if replicates < 2:
            raise ValueError(f"an error needs at least 2 replicates, not {replicates}")
        if not points.is_random:
            raise ValueError(f"{points!r} has no randomness to replicate; choose a scramble other than 'none'")
        self._integrand = integrand
        self.points = points
        self.replicates = replicates
        self.rows = 0
        self.used = np.zeros(replicates, np.int64)
        self.means: NDArray[np.float64] = np.zeros(replicates)

    def resume(self, rows: int, means: NDArray[np.float64]) -> None:
        """Begin with means of that many rows, all of which counted."""
        self.rows, self.means = rows, np.asarray(means, np.float64)
        self.used[:] = rows

    def extend(self, rows: int) -> None:
        """Evaluate all rows up to `rows` of every replicate."""
        engine = _sized(self.points, rows)
        block = rows_per_block(int(engine.d), self.replicates)
        while self.rows < rows:
            self._add(engine, self.rows, min(self.rows + block, rows))

    def check_used(self) -> None:
        """Raise a ValueError if nothing at all is known of a replicate."""
        if not self.used.all():
            raise ValueError(f"f is finite at none of {self.rows} points of replicate {int(self.used.argmin())}")

    def _add(self, engine: Any, start: int, stop: int) -> None:
        count = stop - start
        u = engine.points(start, stop, replicates=self.replicates).reshape(-1, int(engine.d))
        values, finite = self._integrand(u, start, self.replicates)
        sums = values.reshape(self.replicates, count, *values.shape[1:]).sum(axis=1)
        used = np.full(self.replicates, count) if finite is None else finite.reshape(self.replicates, -1).sum(axis=1)
        if self.rows == 0:
            self.means = np.zeros_like(sums)
        total = np.maximum(self.used + used, 1)
        column = (-1, *[1] * (sums.ndim - 1))
        self.means = self.means + (sums - used.reshape(column) * self.means) / total.reshape(column)
        self.used += used
        self.rows = stop


def _sized(points: Any, rows: int) -> Any:
    """A finite set that does not know its number of points yet learns it here."""
    if not getattr(points, "finite", False) or points.n is not None:
        return points
    engine = copy.copy(points)
    engine.random(rows)
    return engine
