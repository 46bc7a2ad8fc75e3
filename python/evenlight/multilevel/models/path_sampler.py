"""What models of stochastic differential equations share: steps along a fine and a coarse grid of times."""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.brownian import CONSTRUCTIONS, brownian_increments
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .row_blocks import row_blocks

__all__ = ["PathSampler"]

Array = NDArray[np.float64]


class PathSampler(LevelSampler):
    """Paths of a vector-valued equation; level l has 2^l times the time steps of level 0.

    A model says `start`, `step` and `payoff`. If it is antithetic, the fine value is the mean of two paths: the second
    one has the two increments within every coarse step swapped. The means are equal, and what a scheme of strong order
    1/2 does wrong for want of Lévy areas cancels (M. B. Giles and L. Szpruch, "Antithetic multilevel Monte Carlo
    estimation for multi-dimensional SDEs without Lévy area simulation", Ann. Appl. Probab. 24(4), 1585-1620, 2014).
    """

    max_level = None
    keyed = False
    whole_path = False
    """True if `payoff` takes the values at all times, shape (steps + 1, d, n), and not only the last."""

    def __init__(
        self,
        start: Any,
        noises: int,
        *,
        horizon: float,
        antithetic: bool,
        construction: str = "incremental",
        first_steps: SupportsIndex = 1,
    ) -> None:
        self.start = np.atleast_1d(np.asarray(start, np.float64))
        if self.start.ndim != 1 or not np.isfinite(self.start).all():
            raise ValueError(f"start must be finite numbers, shape (d,), not {start!r}")
        if not 0.0 < horizon < np.inf:
            raise ValueError(f"horizon must be above 0 and finite, not {horizon}")
        if construction not in CONSTRUCTIONS:
            raise ValueError(f"unknown construction {construction!r}; known: {', '.join(CONSTRUCTIONS)}")
        self.noises = noises
        self.horizon = float(horizon)
        self.antithetic = antithetic
        self.construction = construction
        self.first_steps = integer("first_steps", first_steps, 1)

    def step(self, t: float, x: Array, dw: Array, h: float) -> Array:
        """Values after a step from time t, shape (d, n) as `x`; `dw` are Brownian increments, shape (noises, n)."""
        raise NotImplementedError

    def payoff(self, x: Array) -> Array:
        """The quantity of a block of paths, shape (n,)."""
        raise NotImplementedError

    def steps(self, level: int) -> int:
        """Time steps of the fine path."""
        return self.first_steps << integer("level", level, 0)

    def dims(self, level: int) -> int:
        """The numbers of the Brownian motions, in turns."""
        return self.steps(level) * self.noises

    def cost(self, level: int) -> float:
        """Time steps of all paths."""
        fine = self.steps(level)
        return float(fine * (2 if self.antithetic else 1) + fine // 2 if level else fine)

    def sample(self, level: int, u: Array) -> Coupled:
        """The quantity of the fine path (or the mean of the two) and of the coarse one."""
        numbers = self._checked(level, u)
        fine, coarse = np.empty(len(numbers)), np.zeros(len(numbers))
        for rows in row_blocks(*numbers.shape):
            dw = self._increments(numbers[rows])
            fine[rows] = self._run(dw)
            if level:
                coarse[rows] = self._run(dw[0::2] + dw[1::2])
                if self.antithetic:
                    swapped = dw.reshape(-1, 2, *dw.shape[1:])[:, ::-1].reshape(dw.shape)
                    fine[rows] = 0.5 * (fine[rows] + self._run(swapped))
        return Coupled(fine, coarse, len(numbers) * self.cost(level))

    def ladder(self, level: int, u: Array) -> Array:
        """The quantity along the same motion on all grids up to that of `level`, shape (n, level + 1).

        Raises
        ------
        ValueError
            If the scheme is antithetic: its pairs are closer than any single simulation's levels.
        """
        if self.antithetic:
            raise ValueError(f"{self.name} is antithetic: it has no single simulation on all levels")
        numbers = self._checked(level, u)
        values = np.empty((len(numbers), level + 1))
        for rows in row_blocks(*numbers.shape):
            dw = self._increments(numbers[rows])
            for rung in reversed(range(level + 1)):
                values[rows, rung] = self._run(dw)
                if rung:
                    dw = dw[0::2] + dw[1::2]
        return values

    def _checked(self, level: int, u: Any) -> Array:
        numbers = np.asarray(u, np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != self.dims(level):
            raise ValueError(f"u must have shape (n, {self.dims(level)}) on level {level}, not {numbers.shape}")
        return numbers

    def _increments(self, u: Array) -> Array:
        """Shape (steps, noises, n)."""
        motion = brownian_increments(
            u, horizon=self.horizon, construction=self.construction, factors=self.noises
        ).reshape(len(u), -1, self.noises)
        return np.ascontiguousarray(motion.transpose(1, 2, 0))

    def _run(self, dw: Array) -> Array:
        steps, _, n = dw.shape
        h = self.horizon / steps
        x: Array = np.repeat(self.start[:, np.newaxis], n, axis=1)
        path = [x]
        for k in range(steps):
            x = self.step(k * h, x, dw[k], h)
            if self.whole_path:
                path.append(x)
        values = np.asarray(self.payoff(np.stack(path) if self.whole_path else x), np.float64)
        if values.shape != (n,):
            raise ValueError(f"payoff must return shape ({n},) for {n} paths, not {values.shape}")
        return values
