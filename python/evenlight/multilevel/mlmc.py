"""Multilevel Monte Carlo to a tolerance: independent samples on geometric levels. The method to begin with."""

from __future__ import annotations

import math
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import SeedLike, seed_number
from evenlight.estimate import Estimate
from evenlight.multilevel.allocation import LEAST, degrees_of_freedom, extend, lacking
from evenlight.multilevel.decay import Rates, given_rate, measure_rates, remaining_bias
from evenlight.multilevel.goal import Goal
from evenlight.multilevel.level import Level, LevelRow, compared
from evenlight.multilevel.level_table import sum_of_levels, warn

__all__ = ["mlmc"]

Array = NDArray[np.float64]

_PILOT = (256, 128, 64, 32)  # samples of the first levels: a mean that crosses zero on one of them is no convergence
_SHARE = 0.9  # of the squared tolerance, for bias and variance as estimated
_PATIENCE = 2048  # samples at most to learn whether differences are rare


def mlmc(
    sampler: Any,
    *,
    rmse: float,
    seed: SeedLike = None,
    alpha: float | None = None,
    beta: float | None = None,
    max_level: SupportsIndex | None = None,
    max_cost: float = math.inf,
) -> Estimate:
    """Estimate the limit of a hierarchy of simulations with a root mean squared error of at most `rmse`.

    Parameters
    ----------
    sampler : LevelSampler
        The model: values of levels l and l - 1 from the same random numbers.
    rmse : float
        The tolerance, above 0, for bias and noise together; for each quantity if there are several.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Sample i of a level is a pure function of the seed.
    alpha, beta : float, optional
        Rates that are known: means of differences fall as 2^(-alpha l), their variances as 2^(-beta l). Measured by
        default.
    max_level : int, optional
        The finest level to use; by default the sampler's, or 20.
    max_cost : float, optional
        The most to spend, in the model's units.

    Returns
    -------
    Estimate
        The sum over levels. `cost` is in the model's units; `bias` bounds what the finest level leaves out, and
        widens the confidence intervals. The diagnostics hold `levels` (a tuple of `LevelRow`, see `level_table`),
        `rates` (alpha, beta, gamma), `bias`, `variance` and `warnings`. `converged` is False where a limit came
        before the tolerance.

    Raises
    ------
    TypeError, ValueError
        If an argument or what the sampler returns is not as above; the message names it.

    Warns
    -----
    MultilevelWarning
        If coarse values of a level do not have the mean of the fine ones one level below, or a variance is hardly
        known.
    NotConvergedWarning
        If a limit came before the tolerance.

    Notes
    -----
    Cost for the tolerance ε: ε^-2 for beta > gamma, ε^-2 (log ε)² for beta = gamma, else
    ε^(-2 - (gamma - beta) / alpha), where 2^gamma is the growth of cost from level to level.

    From four pilot levels on, the number of samples of a level is proportional to the root of variance over cost. A
    level is added while the bias, bounded by the means of the last three levels, takes more than half of the tolerance,
    or while another level makes the whole cheaper: what bias leaves is the variance's. Tolerances are approached by
    halving, so that few samples hang on a pilot's variance. Of the squared tolerance, a tenth is kept for what
    estimated variances and rates get wrong: errors are 0.6 to 1 of the tolerance, or less where the pilot alone is
    enough.

    Errors are larger where first means look as if they had converged and have not, or fall so slowly that the noise of
    the last ones is as large as the bias. Barriers that are looked at only at time steps (GeometricBrownianMotion(
    "barrier", "euler")) have both: differences change their sign, grow up to level 4 and then fall with alpha = 1/2.
    Errors are 1 to 1.7 tolerances there, and to give alpha hardly helps; the scheme "milstein" does.

    References: M. B. Giles, "Multilevel Monte Carlo path simulation", Oper. Res. 56(3), 607-617 (2008), and
    "Multilevel Monte Carlo methods", Acta Numerica 24, 259-328 (2015); N. Collier, A.-L. Haji-Ali, F. Nobile, E. von
    Schwerin and R. Tempone, "A continuation multilevel Monte Carlo algorithm", BIT 55, 399-432 (2015).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel import FunctionSampler, mlmc
    >>> def compound(level, u):  # growth at a random rate, compounded 2^l times instead of continuously
    ...     def growth(n):
    ...         return (1 + u[:, 0] / n) ** n
    ...     return growth(2.0**level), growth(2.0 ** (level - 1))
    >>> estimate = mlmc(FunctionSampler(compound), rmse=0.002, seed=7)
    >>> bool(abs(estimate.value - (np.e - 1)) < 0.006)
    True
    >>> rates = estimate.diagnostics["rates"]
    >>> f"{rates.alpha:.1f} {rates.beta:.1f} {rates.gamma:.1f}"
    '0.9 1.7 1.0'
    """
    goal = Goal.of(sampler, rmse, max_level, max_cost, alpha, share=_SHARE)
    run = _Run(sampler, seed_number(seed), goal, given_rate("alpha", alpha), given_rate("beta", beta))
    ends = [run.reach(tolerance) for tolerance in run.tolerances()]
    return warn(run.estimate(ends[-1]))


class _Run:
    """Levels so far, and what they say."""

    def __init__(self, sampler: Any, seed: int, goal: Goal, alpha: float | None, beta: float | None) -> None:
        self._sampler, self._seed, self._goal = sampler, seed, goal
        self._given = (alpha, beta)
        self._levels: list[Level] = []
        for n in _PILOT[: goal.max_level + 1]:
            self._add_level(n)
            self._learn(self._levels[-1])

    def tolerances(self) -> list[float]:
        """From the error of the pilot down to the tolerance, halving."""
        pilot = math.sqrt(max(np.max(level.row.variance) / level.n for level in self._levels))
        steps = max(0, math.floor(math.log2(pilot / self._goal.rmse))) if pilot > 0 else 0
        return [self._goal.rmse * 2.0**step for step in range(steps, -1, -1)]

    def reach(self, rmse: float) -> str:
        """Add samples and levels until bias and noise are within the tolerance; say what was in the way, if so."""
        while True:
            rates = self._rates()
            bias = self._bias(rates.beta)
            more = lacking(self._levels, self._variances(rates.beta), self._goal.variance(rmse, bias))
            if more.any():
                if not extend(self._levels, more, self._goal.max_cost - self._cost()):
                    return self._goal.too_expensive
            elif not self._wants_level(rmse, bias, rates):
                return ""
            elif len(self._levels) > self._goal.max_level:
                return "" if self._goal.fits(rmse, bias) else self._goal.too_coarse
            elif self._cost() + LEAST * self._sampler.cost(len(self._levels)) > self._goal.max_cost:
                return self._goal.too_expensive
            else:
                self._add_level(LEAST)

    def estimate(self, obstacle: str) -> Estimate:
        rows = compared(self._rows())
        rates = self._rates()
        return sum_of_levels(
            rows,
            rates,
            self._bias(rates.beta),
            replicates=sum(row.n for row in rows),
            cost=self._cost(),
            method="mlmc",
            converged=not obstacle,
            message=obstacle or "tolerance reached",
            degrees_of_freedom=degrees_of_freedom(rows),
        )

    def _rows(self) -> list[LevelRow]:
        return [level.row for level in self._levels]

    def _cost(self) -> float:
        return sum(level.cost for level in self._levels)

    def _rates(self) -> Rates:
        return measure_rates(self._rows(), *self._given)

    def _bias(self, beta: float) -> Any:
        if self._goal.exact and len(self._levels) == self._goal.max_level + 1:
            return np.zeros_like(self._levels[0].row.mean)
        return remaining_bias(self._rows(), self._given[0], beta)

    def _variances(self, beta: float) -> Array:
        """Of all levels, shape (levels, quantities): as measured, and as the level before lets expect, together.

        The expectation weighs as many samples as it takes to know a variance to a factor 2 or so, four times the
        kurtosis, and at least half of it counts (Giles 2015): few samples of a heavy tail do not show it.
        """
        variances = np.array([np.atleast_1d(level.row.variance) for level in self._levels])
        tails = np.array([np.atleast_1d(level.row.kurtosis) for level in self._levels])
        tails = np.maximum.accumulate(np.where(np.isfinite(tails), tails, 3.0), axis=0)
        for fine in range(2, len(variances)):
            expected, weight = variances[fine - 1] * 2.0**-beta, 4.0 * tails[fine - 1]
            n = self._levels[fine].n
            variances[fine] = np.maximum((weight * expected + n * variances[fine]) / (weight + n), 0.5 * expected)
        return variances

    def _add_level(self, n: int) -> None:
        level = Level(self._sampler, len(self._levels), self._seed)
        level.extend(n)
        self._levels.append(level)

    def _learn(self, level: Level) -> None:
        """Double the samples until rare differences show: until there are ten for a kurtosis of one."""
        while level.n < _PATIENCE and not np.all(10.0 * np.asarray(level.row.kurtosis) <= level.n):
            level.extend(2 * level.n)

    def _wants_level(self, rmse: float, bias: Any, rates: Rates) -> bool:
        """Whether the bias is too large, or the whole is cheaper with another level."""
        if not self._goal.fits(rmse, bias):
            return True
        variances = self._variances(rates.beta)
        costs = np.array([[level.row.cost] for level in self._levels])
        roots = np.sqrt(variances * costs).sum(axis=0)
        next_cost = costs[-1] * 2.0**rates.gamma
        next_roots = roots + np.sqrt(variances[-1] * 2.0**-rates.beta * next_cost)
        now = roots**2 / self._goal.variance(rmse, bias)
        then = next_roots**2 / self._goal.variance(rmse, bias * 2.0**-rates.alpha) + LEAST * next_cost
        return float(np.max(then)) < float(np.max(now))
