"""Slice sampling, coordinate by coordinate: no gradient, widths that need not be right. For targets of odd scales."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity
from evenlight.mcmc.target import DensityState, density_state, evaluate

__all__ = ["Slice", "SliceInfo"]


@dataclass(frozen=True, eq=False)
class SliceInfo(Info):
    """What a sweep has to tell; `acceptance` is the share of coordinates that moved."""

    evaluations: Array
    """Values of the log density that each chain took."""


@dataclass(frozen=True, eq=False)
class Slice(Kernel):
    """Univariate slice sampling with stepping out and shrinkage, one sweep over the coordinates a step.

    A coordinate costs about 4 to 6 values of the log density [1]_. The number of uniform numbers is bounded: a
    coordinate for which `tries` points of the shrinking interval miss the slice stays; that is rare, and leaves the
    target invariant.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    width : float or array_like, shape (d,)
        Of the first interval: some standard deviations of the coordinate.
    steps_out : int
        The most widths that an interval may have.
    tries : int
        The most points that are tried.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Why staying is allowed: the way back passes the same points that missed, in the same intervals (the argument for
    shrinkage), so that it fails within `tries` as often.

    References
    ----------
    .. [1] R. M. Neal, "Slice sampling", Ann. Stat. 31(3), 705-767 (2003).

    Examples
    --------
    >>> from evenlight.mcmc import Slice, run
    >>> chains = run(Slice(lambda x: -abs(x[:, 0]), width=4.0), [0.0], n=2000, chains=8, burn_in=20, seed=1)
    >>> estimate = chains.estimate(lambda x: abs(x[:, 0]))
    >>> abs(estimate.value - 1) < 4 * estimate.standard_error < 0.2
    True
    """

    name: ClassVar[str] = "slice"

    log_density: LogDensity
    width: Any = 1.0
    steps_out: int = 8
    tries: int = 12

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        width = np.asarray(self.width, np.float64)
        if width.ndim > 1 or not ((width > 0) & np.isfinite(width)).all():
            raise ValueError(
                f"width must be finite and above 0, one number or one for each coordinate, not {self.width}"
            )
        integer("steps_out", self.steps_out, 1)
        integer("tries", self.tries, 1)

    def dims(self, d: int) -> int:
        """For each coordinate the level, the place of the interval, how it grows, and the points tried."""
        return d * (3 + self.tries)

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, SliceInfo]:
        """Update all coordinates, the first one first."""
        chains, d = state.position.shape
        x, values = state.position.copy(), state.log_density.copy()
        widths = np.broadcast_to(np.asarray(self.width, np.float64), d)
        stayed, evaluations = np.zeros(chains), np.zeros(chains)
        for j, u in enumerate(np.split(uniforms, d, axis=1)):
            level = values + np.log(u[:, 0])

            def inside(rows: Any, at: Array, j: int = j) -> Array:
                tried = x[rows].copy()
                tried[:, j] = at
                evaluations[rows] += 1
                return evaluate(self.log_density, tried)

            low = x[:, j] - widths[j] * u[:, 1]
            ends = self._step_out(inside, level, (low, low + widths[j], widths[j]), u[:, 2])
            stayed += self._shrink(inside, (x, values, j), (level, *ends), u[:, 3:])
        moved = 1 - stayed / d
        return DensityState(x, values), SliceInfo(moved, moved > 0, evaluations)

    def _step_out(
        self, inside: Callable[[Any, Array], Array], level: Array, interval: tuple[Array, Array, float], u: Array
    ) -> tuple[Array, Array]:
        """Move both ends out by widths until they are outside the slice; a random share of the widths for each."""
        low, high, width = interval
        to_left = np.floor(self.steps_out * u)
        for end, sign, steps in ((low, -1.0, to_left), (high, 1.0, self.steps_out - 1 - to_left)):
            rows = np.flatnonzero(steps > 0)
            for taken in range(1, self.steps_out):
                rows = rows[inside(rows, end[rows]) > level[rows]] if len(rows) else rows
                end[rows] += sign * width
                rows = rows[steps[rows] > taken]
        return low, high

    def _shrink(
        self,
        inside: Callable[[Any, Array], Array],
        chains: tuple[Array, Array, int],
        interval: tuple[Array, Array, Array],
        u: Array,
    ) -> Array:
        """Try points, and cut the interval at those outside the slice. Moves the chains; returns which of them stay."""
        x, values, j = chains
        level, low, high = interval
        rows = np.arange(len(x))
        for tried in range(self.tries):
            at = low[rows] + u[rows, tried] * (high[rows] - low[rows])
            found = inside(rows, at)
            hit = found > level[rows]
            x[rows[hit], j], values[rows[hit]] = at[hit], found[hit]
            rows, at = rows[~hit], at[~hit]
            if not len(rows):
                break
            below = at < x[rows, j]
            low[rows[below]], high[rows[~below]] = at[below], at[~below]
        stays = np.zeros(len(x))
        stays[rows] = 1
        return stays
