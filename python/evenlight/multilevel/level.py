"""The state of one level: samples by their number, and the sums that everything is judged by."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenlight import _core
from evenlight.multilevel.level_sampler import draw
from evenlight.multilevel.work_arrays import work_array
from evenlight.points import Engine, Independent

__all__ = ["Level", "LevelRow", "compared", "level_points", "plain"]

Array = NDArray[np.float64]

_BLOCK = 2**17  # numbers drawn at once: blocks have their overhead
_ROUNDING = 1e-12  # of the mean: differences below it are none


class LevelRow(NamedTuple):
    """A level as a line of a table; arrays where a sample has several values.

    Examples
    --------
    >>> from evenlight.multilevel import LevelRow
    >>> LevelRow(0, 1000, 10.4, 160.0, 1.0).n
    1000
    """

    level: Any
    """Its number, or pair of numbers."""
    n: int
    """Samples."""
    mean: Any
    """Of the difference, fine minus coarse."""
    variance: Any
    """Of the difference of one sample; with evenly spread points, n times that of the mean."""
    cost: float
    """Per sample."""
    kurtosis: Any = math.nan
    """Of the difference: beyond about 100, its variance is hardly known."""
    consistency: Any = math.nan
    """|mean of fine one level below - mean of coarse| over what it may be (Giles 2015); above 1, they do not fit."""
    fine_mean: Any = math.nan
    """Of the fine value."""
    fine_variance: Any = math.nan
    """Of the fine value of one sample, or as `variance`."""

    def compared(self, *below: LevelRow, signs: tuple[int, ...] = (1,)) -> LevelRow:
        """The row with its consistency: |a - b + c| / (3 (√V_a + √V_b + √V_c)), section 3.3 of Giles (2015).

        a is the signed sum of the means of fine values of the levels below, b that of this one, c is the mean of the
        difference.
        """
        expected = sum(sign * np.asarray(row.fine_mean) for sign, row in zip(signs, below, strict=True))
        gap = np.abs(expected - self.fine_mean + self.mean)
        variances = [row.fine_variance / row.n for row in (*below, self)]
        spread = sum(np.sqrt(variance) for variance in [*variances, self.variance / self.n])
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(gap > _ROUNDING * np.abs(self.fine_mean), gap / (3 * spread), 0.0)
        return self._replace(consistency=float(ratio) if ratio.ndim == 0 else ratio)


def level_points(points: Engine | None, dims: int, level: Any, seed: int) -> Engine:
    """The points of a level, independent of those of all others; independent points if none are given."""
    for part in np.atleast_1d(level):
        seed = _core.replicate_seed(seed, int(part))
    return Independent(dims, seed=seed) if points is None else points._other(dims, seed)


class Level:
    """Independent samples of one level, as many as asked so far.

    Sample i is a pure function of (seed, level, i). Sums are of powers of deviations from the mean of the first block.
    """

    def __init__(self, sampler: Any, level: Any, seed: int) -> None:
        self.level = level
        self._sampler = sampler
        self._points = level_points(None, sampler.dims(level), level, seed)
        self._room: Array = np.empty((0, int(self._points.d)))
        self.n = 0
        self.cost = 0.0
        self._row: LevelRow | None = None

    def extend(self, n: int) -> None:
        """Draw samples until there are n."""
        block = max(1, _BLOCK // int(self._points.d))
        while self.n < n:
            self._add(self.n, min(n, self.n + block))

    @property
    def row(self) -> LevelRow:
        """The level as a line of a table, without its consistency."""
        if self._row is None:
            self._row = self._judged()
        return self._row

    def _add(self, start: int, stop: int) -> None:
        if len(self._room) < stop - start:
            self._room = np.empty((stop - start, int(self._points.d)))
        u = self._points.points(start, stop, out=self._room[: stop - start])
        coupled = draw(self._sampler, self.level, u)
        fine = coupled.fine
        step, square = work_array("step", fine.shape), work_array("square", fine.shape)
        np.subtract(fine, coupled.coarse, out=step)
        if start == 0:
            self._center = step.mean(axis=0)
            self._fine_center = fine.mean(axis=0)
            self._powers = np.zeros((4, *step.shape[1:]))
            self._fine_powers = np.zeros((2, *step.shape[1:]))
        step -= self._center
        np.multiply(step, step, out=square)
        self._powers += [step.sum(axis=0), square.sum(axis=0), _dot(square, step), _dot(square, square)]
        np.subtract(fine, self._fine_center, out=step)
        self._fine_powers += [step.sum(axis=0), _dot(step, step)]
        self.n = stop
        self.cost += coupled.cost
        self._row = None

    def _judged(self) -> LevelRow:
        m1, m2, m3, m4 = self._powers / self.n
        f1, f2 = self._fine_powers / self.n
        central = m4 - 4 * m1 * m3 + 6 * m1**2 * m2 - 3 * m1**4
        unbiased = self.n / max(self.n - 1, 1)
        with np.errstate(invalid="ignore", divide="ignore"):
            return LevelRow(
                self.level,
                self.n,
                plain(self._center + m1),
                plain(np.maximum(m2 - m1**2, 0.0) * unbiased),
                self.cost / self.n,
                plain(central / (m2 - m1**2) ** 2),
                fine_mean=plain(self._fine_center + f1),
                fine_variance=plain(np.maximum(f2 - f1**2, 0.0) * unbiased),
            )


def compared(rows: Sequence[LevelRow]) -> list[LevelRow]:
    """Rows of levels 0, 1, …, each compared with the one below."""
    return [rows[0], *(row.compared(below) for below, row in pairwise(rows))]


def plain(number: Any) -> Any:
    """A float for a number, an array for an array."""
    return float(number) if np.ndim(number) == 0 else np.asarray(number)


def _dot(x: Array, y: Array) -> Any:
    """Sums of products along the first axis; without the threads of linear algebra, which wait for each other."""
    return np.einsum("i...,i...->...", x, y)
