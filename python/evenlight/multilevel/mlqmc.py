"""Multilevel quasi-Monte Carlo: evenly spread points on every level. For smooth problems, where it needs far less."""

from __future__ import annotations

import math
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import SeedLike, integer, seed_number
from evenlight.estimate import Estimate
from evenlight.intervals import degrees_of_sum
from evenlight.multilevel.decay import Rates, given_rate, measure_rates, remaining_bias
from evenlight.multilevel.goal import Goal
from evenlight.multilevel.level import LevelRow, compared
from evenlight.multilevel.level_table import sum_of_levels, warn
from evenlight.multilevel.replicated_level import ReplicatedLevel
from evenlight.points import Engine, Sobol

__all__ = ["mlqmc"]

Array = NDArray[np.float64]

_PILOT = (8, 4, 2, 1)  # points of each replicate on the first levels
_SHARE = 0.65  # of the squared tolerance, for bias and variance as estimated: runs end when replicates happen to agree


def mlqmc(
    sampler: Any,
    points: Engine | None = None,
    *,
    rmse: float,
    replicates: SupportsIndex = 32,
    seed: SeedLike = None,
    alpha: float | None = None,
    max_level: SupportsIndex | None = None,
    max_cost: float = math.inf,
) -> Estimate:
    """Estimate the limit of a hierarchy of simulations with a root mean squared error of at most `rmse`.

    Parameters
    ----------
    sampler : LevelSampler
        The model. Its first columns should matter most: paths by a bridge or by principal components.
    points : evenlight.points.Engine, optional
        Which points to use, such as ``Lattice(1)``: sequences with randomness and without end. Their dimensions are the
        model's and their seed follows from `seed`, whatever those of the example. Scrambled Sobol' points by default.
    rmse : float
        The tolerance, above 0, for bias and noise together; for each quantity if there are several.
    replicates : int
        Independent randomizations on each level, at least 8, whose spread is the variance.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.
    alpha : float, optional
        The rate at which the means of differences fall, 2^(-alpha l), if it is known.
    max_level : int, optional
        The finest level to use; by default the sampler's, or 20.
    max_cost : float, optional
        The most to spend, in the model's units.

    Returns
    -------
    Estimate
        The sum over levels; attributes and diagnostics are those of `mlmc`. The variance of a row of the table of
        levels is N times that of the level's mean.

    Raises
    ------
    TypeError, ValueError
        If an argument or what the sampler returns is not as above, or the sampler's columns are keys (`keyed`).

    Warns
    -----
    MultilevelWarning
        If coarse values of a level do not have the mean of the fine ones one level below.
    NotConvergedWarning
        If a limit came before the tolerance.

    Notes
    -----
    The points are doubled on the level where the variance of the mean over the cost of its points is largest, until the
    sum of variances is small enough. Levels are added as in `mlmc`. The cost falls from ε^-2 to about ε^-1.5 or less
    where the integrands of the levels are smooth. A run tends to end when replicates happen to agree, so a third of the
    squared tolerance is kept for that: errors are 0.5 to 1 of the tolerance.

    Reference: M. B. Giles and B. J. Waterhouse, "Multilevel quasi-Monte Carlo path simulation", Advanced Financial
    Modelling, Radon Series Comp. Appl. Math. 8, 165-181 (2009).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import FunctionSampler, mlmc, mlqmc
    >>> from evenlight.points import Lattice
    >>> def compound(level, u):  # growth at a random rate, compounded 2^l times instead of continuously
    ...     def growth(n):
    ...         return (1 + u[:, 0] / n) ** n
    ...     return growth(2.0**level), growth(2.0 ** (level - 1))
    >>> estimate = mlqmc(FunctionSampler(compound), rmse=1e-4, seed=7)
    >>> bool(abs(estimate.value - (np.e - 1)) < 3e-4)
    True
    >>> mlqmc(FunctionSampler(compound), Lattice(1), rmse=1e-3, seed=7).method
    'mlqmc'
    """
    goal = Goal.of(sampler, rmse, max_level, max_cost, alpha, share=_SHARE)
    copies = integer("replicates", replicates, 8)
    template = Sobol(1) if points is None else points
    _check_points(sampler, template)
    run = _Run(sampler, template, (seed_number(seed), copies), goal, given_rate("alpha", alpha))
    return warn(run.estimate(run.reach()))


def _check_points(sampler: Any, points: Engine) -> None:
    if not isinstance(points, Engine):
        raise TypeError(f"points must be one of evenlight.points, such as Sobol(1), not {type(points).__name__}")
    if points.finite or not points.is_random:
        lack = "an end" if points.finite else "no randomness"
        raise ValueError(f"{points!r} has {lack}; points must be a randomized sequence without end, such as Sobol(1)")
    if getattr(sampler, "keyed", False):
        raise ValueError(
            f"sampler {sampler.name!r} takes its columns as keys of a generator, so that evenly spread points are "
            "of no use to it; use mlmc"
        )


class _Run:
    """Levels so far, and what they say."""

    def __init__(self, sampler: Any, points: Engine, random: tuple[int, int], goal: Goal, alpha: float | None) -> None:
        self._sampler, self._points, self._goal, self._alpha = sampler, points, goal, alpha
        self._seed, self._replicates = random
        self._levels: list[ReplicatedLevel] = []
        for n in _PILOT[: goal.max_level + 1]:
            self._add_level(n)

    def reach(self) -> str:
        """Double points and add levels until the tolerance is met; say what was in the way, if anything."""
        goal = self._goal
        while True:
            bias = self._bias()
            budget = goal.variance(goal.rmse, bias)
            variances = self._variances()
            if np.any(sum(variances) > budget):
                if not self._double(variances, budget):
                    return goal.too_expensive
            elif goal.fits(goal.rmse, bias):
                return ""
            elif len(self._levels) > goal.max_level:
                return goal.too_coarse
            elif self._cost() + self._replicates * self._sampler.cost(len(self._levels)) > goal.max_cost:
                return goal.too_expensive
            else:
                self._add_level(1)

    def estimate(self, obstacle: str) -> Estimate:
        rates = self._rates()
        return sum_of_levels(
            compared(self._rows()),
            rates,
            self._bias(),
            replicates=self._replicates,
            cost=self._cost(),
            method="mlqmc",
            converged=not obstacle,
            message=obstacle or "tolerance reached",
            degrees_of_freedom=self._degrees(),
            diagnostics={"points": (f"{self._points!r} on every level",)},
        )

    def _rows(self) -> list[LevelRow]:
        return [level.row for level in self._levels]

    def _cost(self) -> float:
        return sum(level.cost for level in self._levels)

    def _rates(self) -> Rates:
        return measure_rates(self._rows(), self._alpha, None)

    def _bias(self) -> Any:
        if self._goal.exact and len(self._levels) == self._goal.max_level + 1:
            return np.zeros_like(self._levels[0].row.mean)
        return remaining_bias(self._rows(), self._alpha)

    def _variances(self) -> list[Any]:
        """Of the means of all levels: as measured, and per point at least a sixth of that of the level before.

        Where variances fall as 2^-β with β < 2.6, they are more than that: fewer points of a finer level are spread no
        more evenly. It keeps a level from looking quiet by chance.
        """
        rows = self._rows()
        variances = [level.variance for level in self._levels]
        for fine in range(2, len(rows)):  # level 0 is no difference
            variances[fine] = np.maximum(variances[fine], rows[fine - 1].variance / (6.0 * rows[fine].n))
        return variances

    def _double(self, variances: list[Any], budget: Any) -> bool:
        """Double the points where most variance goes for the cost, unless that costs too much."""
        gains = [float(np.max(v / budget)) / level.cost for v, level in zip(variances, self._levels, strict=True)]
        level = self._levels[int(np.argmax(gains))]
        if self._cost() + level.cost > self._goal.max_cost:
            return False
        level.extend(2 * level.n)
        return True

    def _add_level(self, n: int) -> None:
        level = ReplicatedLevel(self._sampler, len(self._levels), self._points, self._seed, self._replicates)
        level.extend(n)
        self._levels.append(level)

    def _degrees(self) -> float:
        variances = [level.variance for level in self._levels]
        return degrees_of_sum(variances, [self._replicates - 1] * len(variances))
