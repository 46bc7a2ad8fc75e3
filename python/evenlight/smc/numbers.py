"""The uniform numbers of one replicate: independent point sets for the start and for every step, of any sequence."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight import _core
from evenlight.points import Engine, Sobol

__all__ = ["StepNumbers", "example_points"]

Array = NDArray[np.float64]


def example_points(points: Any) -> Engine:
    """The sequence to use, given as a class or as an example; scrambled Sobol' points by default."""
    engine = Sobol(1) if points is None else points(1) if isinstance(points, type) else points
    if not isinstance(engine, Engine):
        raise TypeError(f"points must be one of evenlight.points, such as Sobol, not {type(engine).__name__}")
    if engine.finite or not engine.is_random:
        lack = "an end" if engine.finite else "no randomness"
        raise ValueError(f"{engine!r} has {lack}; points must be a randomized sequence without end, such as Sobol")
    return engine


class StepNumbers:
    """n points for the start and n for every step, all sets independent, pure functions of seeds and step.

    Parameters
    ----------
    example : evenlight.points.Engine
        The sequence.
    n : int
        Points in each set.
    columns : int
        Numbers in each point of a step.
    *seeds : int
        The seed, and what splits it: numbers with other ones are independent.
    """

    def __init__(self, example: Engine, n: int, columns: int, *seeds: int) -> None:
        self._example, self._n, self._columns = example, n, columns
        seed, *splits = seeds
        for split in splits:
            seed = _core.replicate_seed(seed, split)
        self._seed = seed
        self._moves = self._points(columns)

    def start(self, columns: int) -> Array:
        """The points of the start, shape (n, columns)."""
        return self._fill(self._points(columns), columns, 0)

    def step(self, number: int) -> Array:
        """The points of a step, from 0 on, shape (n, columns)."""
        return self._fill(self._moves, self._columns, 1 + number)

    def _points(self, columns: int) -> Any:
        """The sequence in as many dimensions; seeds come with `_fill`, which costs less than building it anew."""
        return self._example._other(columns)._core

    def _fill(self, points: Any, columns: int, part: int) -> Array:
        out: Array = np.empty((self._n, columns))
        points.fill_replicates(_core.replicate_seed(self._seed, part), (0, self._n), 1, out[np.newaxis], 1)
        return out
