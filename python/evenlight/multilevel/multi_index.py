"""Multi-index Monte Carlo: two directions of refinement at once, such as steps in space and in time.

Where a multilevel method would refine both together, this one takes mixed differences, which fall faster: pairs of
levels that are fine in both directions are hardly needed.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import SeedLike, seed_number
from evenlight.estimate import Estimate
from evenlight.multilevel.allocation import LEAST, degrees_of_freedom, extend, lacking
from evenlight.multilevel.goal import Goal
from evenlight.multilevel.level import Level, LevelRow
from evenlight.multilevel.level_table import sum_of_levels, warn
from evenlight.multilevel.pair_decay import Pair, fit_planes

__all__ = ["multi_index"]

Array = NDArray[np.float64]

_PILOT = (256, 128, 64, 32, 32)  # samples of the first pairs, by the sum of their levels
_SHARE = 0.75  # of the squared tolerance, for bias and variance as estimated
_BEYOND = 24  # levels beyond the sampled ones whose bias is added up
_FIRST: tuple[Pair, ...] = tuple((i, total - i) for total in range(len(_PILOT)) for i in range(total + 1))


def multi_index(
    sampler: Any,
    *,
    rmse: float,
    seed: SeedLike = None,
    max_cost: float = math.inf,
) -> Estimate:
    """Estimate the limit of simulations with two discretizations with a root mean squared error of at most `rmse`.

    Parameters
    ----------
    sampler : MultiIndexSampler
        The model: mixed differences at pairs of levels. Each direction has at least the levels 0 to 2.
    rmse : float
        The tolerance, above 0, for bias and noise together; for each quantity if there are several.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.
    max_cost : float, optional
        The most to spend, in the model's units.

    Returns
    -------
    Estimate
        The sum over pairs of levels. Attributes and diagnostics are those of `mlmc`; `rates` is a pair of `Rates`,
        one for each direction.

    Raises
    ------
    TypeError, ValueError
        If an argument or what the sampler returns is not as above; the message names it.

    Warns
    -----
    MultilevelWarning
        If coarse values do not have the mean of the fine ones below, or a variance is hardly known.
    NotConvergedWarning
        If a limit came before the tolerance.

    Notes
    -----
    The set of pairs grows one by one: of those whose predecessors are all there, the one whose mean is largest for what
    it adds to the cost. Means and variances of pairs that are not sampled follow from a plane through the
    logarithms of those that are, but the mean of a pair that comes next counts at least as much as the largest of its
    predecessors: differences need not fall evenly, as where a mesh is too coarse for the terms of a random field. The
    sum of such means is the bias; where they do fall evenly, that is up to 2^alpha times too much. Samples are
    distributed as in `mlmc`, but all pairs whose levels have a sum of at most 4 are sampled at any tolerance.

    Where mixed differences fall as products, the cost is that of the worse of both directions, up to logarithms.

    Reference: A.-L. Haji-Ali, F. Nobile and R. Tempone, "Multi-index Monte Carlo: when sparsity meets sampling",
    Numer. Math. 132, 767-806 (2016).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import Coupled, MultiIndexSampler, multi_index
    >>> class Rule(MultiIndexSampler):  # the mean of exp(x y) over (0, 1)² and a random factor, by midpoint rules
    ...     name = "midpoints"
    ...     def dims(self, level):
    ...         return 1
    ...     def cost(self, level):
    ...         return 2.0 ** sum(level)
    ...     def value(self, u, i, j):
    ...         if min(i, j) < 0:
    ...             return np.zeros(len(u))
    ...         x, y = ((np.arange(2**k) + 0.5) / 2**k for k in (i, j))
    ...         return 2 * u[:, 0] * np.exp(np.outer(x, y)).mean()
    ...     def sample(self, level, u):
    ...         i, j = level
    ...         coarse = self.value(u, i - 1, j) + self.value(u, i, j - 1) - self.value(u, i - 1, j - 1)
    ...         return Coupled(self.value(u, i, j), coarse, len(u) * self.cost(level))
    >>> estimate = multi_index(Rule(), rmse=0.003, seed=1)
    >>> bool(abs(estimate.value - 1.3179021514544) < 0.01)
    True
    """
    last = _last(sampler)
    exact = bool(getattr(sampler, "exact", False))
    run = _Run(sampler, seed_number(seed), Goal.plain(sampler, rmse, last, max_cost, exact, share=_SHARE))
    return warn(run.estimate(run.reach()))


def _last(sampler: Any) -> tuple[float, float]:
    finest = getattr(sampler, "max_level", (None, None))
    if not (isinstance(finest, tuple) and len(finest) == 2):
        raise TypeError(f"sampler must be a MultiIndexSampler, whose max_level is a pair, not {finest!r}")
    first, second = (math.inf if level is None else level for level in finest)
    if min(first, second) < 2:
        raise ValueError(f"max_level = {finest} is too coarse to know the bias; levels 0 to 2 of each are needed")
    return first, second


def _predecessors(i: int, j: int) -> list[Pair]:
    return [pair for pair in ((i - 1, j), (i, j - 1)) if min(pair) >= 0]


class _Run:
    """Pairs of levels so far, and what they say."""

    def __init__(self, sampler: Any, seed: int, goal: Goal) -> None:
        self._sampler, self._seed, self._goal = sampler, seed, goal
        self._levels: dict[Pair, Level] = {}
        for pair in _FIRST:
            if pair[0] <= goal.max_level[0] and pair[1] <= goal.max_level[1]:
                self._add(pair, _PILOT[sum(pair)])
        self._look()

    def reach(self) -> str:
        """Add samples and pairs until bias and noise are within the tolerance; say what was in the way, if so."""
        goal = self._goal
        while True:
            levels = list(self._levels.values())
            more = lacking(levels, self._variances(), goal.variance(goal.rmse, self._bias))
            best = self._best()
            if more.any():
                if not extend(levels, more, goal.max_cost - self._cost()):
                    return goal.too_expensive
            elif best is None or not goal.fits(goal.rmse, self._unreachable):
                return "" if goal.fits(goal.rmse, self._bias) else goal.too_coarse
            elif not self._is_worth_it(best):
                return ""
            elif self._cost() + LEAST * self._sampler.cost(best) > goal.max_cost:
                return goal.too_expensive
            else:
                self._add(best, LEAST)
            self._look()

    def estimate(self, obstacle: str) -> Estimate:
        return sum_of_levels(
            [self._compared(row) for row in self._rows.values()],
            self._rates,
            self._bias,
            replicates=sum(row.n for row in self._rows.values()),
            cost=self._cost(),
            method="multi_index",
            converged=not obstacle,
            message=obstacle or "tolerance reached",
            degrees_of_freedom=degrees_of_freedom(list(self._rows.values())),
        )

    def _add(self, pair: Pair, n: int) -> None:
        level = Level(self._sampler, pair, self._seed)
        level.extend(n)
        self._levels[pair] = level

    def _look(self) -> None:
        """Judge all pairs anew: their rates, and the bias: the means of all that are not sampled, or cannot be."""
        self._rows = {pair: level.row for pair, level in self._levels.items()}
        self._means, self._expected, self._rates = fit_planes(list(self._rows.values()))
        sizes = [max(pair[k] for pair in self._levels) + _BEYOND for k in (0, 1)]
        if self._goal.exact:
            sizes = [min(size, last + 1) for size, last in zip(sizes, self._goal.max_level, strict=True)]
        beyond = self._means.at(*np.indices(sizes))
        beyond[tuple(np.array(list(self._levels)).T)] = 0.0
        self._next = {pair: self._expected_mean(pair) for pair in self._candidates()}
        for pair, mean in self._next.items():
            beyond[pair] = mean
        shape = np.shape(self._rows[0, 0].mean)
        self._bias = beyond.sum(axis=(0, 1)).reshape(shape)
        first, second = np.indices(sizes)
        past = (first > self._goal.max_level[0]) | (second > self._goal.max_level[1])
        self._unreachable = beyond[past].sum(axis=0).reshape(shape)

    def _compared(self, row: LevelRow) -> LevelRow:
        i, j = row.level
        terms = {(i - 1, j): 1, (i, j - 1): 1, (i - 1, j - 1): -1}
        below = {pair: sign for pair, sign in terms.items() if pair in self._rows}
        return row.compared(*map(self._rows.__getitem__, below), signs=tuple(below.values())) if below else row

    def _cost(self) -> float:
        return sum(level.cost for level in self._levels.values())

    def _variances(self) -> Array:
        """Of all pairs; beyond the first ones none much below what all together let expect."""
        variances = np.array([np.atleast_1d(row.variance) for row in self._rows.values()])
        late = [k for k, pair in enumerate(self._rows) if pair not in _FIRST]
        if late:
            expected = self._expected.at(*np.array(list(self._rows))[late].T)
            variances[late] = np.maximum(variances[late], 0.5 * expected)
        return variances

    def _candidates(self) -> list[Pair]:
        """The pairs that may be added: all of their predecessors are there."""
        outside = {(i + di, j + dj) for i, j in self._levels for di, dj in ((1, 0), (0, 1))} - set(self._levels)
        first, second = self._goal.max_level
        return [
            (i, j)
            for i, j in sorted(outside)
            if i <= first and j <= second and all(p in self._levels for p in _predecessors(i, j))
        ]

    def _expected_mean(self, pair: Pair) -> Array:
        """Of a candidate: what the plane says, and no less than the largest of its predecessors."""
        below = [np.abs(np.atleast_1d(self._rows[p].mean)) for p in _predecessors(*pair)]
        return np.asarray(np.maximum(self._means.at(*pair), np.max(below, axis=0)))

    def _best(self) -> Pair | None:
        """The candidate with the largest mean for what it adds to the cost."""
        roots = self._roots()
        return max(
            self._next,
            key=lambda pair: float(np.max(self._next[pair] / self._price(pair, roots))),
            default=None,
        )

    def _roots(self) -> Any:
        """The sum over pairs of roots of variance times cost, whose square over the variance is the whole cost."""
        costs = np.array([[row.cost] for row in self._rows.values()])
        return np.sqrt(self._variances() * costs).sum(axis=0)

    def _price(self, pair: Pair, roots: Any) -> Any:
        """What a pair adds to the whole cost; never less than a few samples of it."""
        cost = self._sampler.cost(pair)
        grown = roots + np.sqrt(np.maximum(self._expected.at(*pair), 0.0) * cost)
        variance = self._goal.variance(self._goal.rmse, np.atleast_1d(self._bias))
        return (grown**2 - roots**2) / variance + LEAST * cost

    def _is_worth_it(self, pair: Pair) -> bool:
        """Whether the bias is too large, or the whole is cheaper with the pair, as it leaves more to the variance."""
        goal, bias, roots = self._goal, np.atleast_1d(self._bias), self._roots()
        if not goal.fits(goal.rmse, bias):
            return True
        now = roots**2 / goal.variance(goal.rmse, bias)
        then = now + self._price(pair, roots)
        then *= goal.variance(goal.rmse, bias) / goal.variance(goal.rmse, bias - self._next[pair])
        return float(np.max(then)) < float(np.max(now))
