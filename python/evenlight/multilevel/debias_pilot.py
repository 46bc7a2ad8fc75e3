"""What a pilot says about a hierarchy to be summed without bias: whether that can work, and the best random level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.multilevel.decay import Rates, given_rate, measure_rates
from evenlight.multilevel.level import Level, LevelRow, level_points
from evenlight.multilevel.level_distribution import LevelDistribution, best_for_single_term, best_for_sum

__all__ = ["Plan", "choose_distribution", "ladder_cost"]

Array = NDArray[np.float64]

_LEVELS = 6
_SAMPLES = 1024
_MARGIN = 0.15  # by which a measured beta must exceed gamma: regressions over six levels err by about that


@dataclass(frozen=True)
class Plan:
    """A distribution of the random level, and what it rests on."""

    distribution: LevelDistribution
    rates: Rates
    cost: float
    """Of the pilot."""


def choose_distribution(
    sampler: Any, method: str, distribution: LevelDistribution | None, seed: int, beta: float | None
) -> Plan:
    """Measure, refuse what cannot work, and take the distribution given or the best one."""
    given_rate("beta", beta)
    last = getattr(sampler, "max_level", None)
    if last is not None and not getattr(sampler, "exact", False):
        raise ValueError(f"the finest level {last} of sampler {sampler.name!r} is not exact: its bias would stay")
    if method == "coupled" and not callable(getattr(sampler, "ladder", None)):
        raise ValueError(f"method 'coupled' needs a sampler with the method 'ladder'; {sampler.name!r} has none")
    levels = [Level(sampler, level, seed) for level in range(_LEVELS if last is None else min(_LEVELS, last + 1))]
    for level in levels:
        level.extend(_SAMPLES)
    rows = [level.row for level in levels]
    if np.ndim(rows[0].mean):
        raise ValueError(f"sampler {sampler.name!r} gives several quantities; debias takes one at a time")
    rates = measure_rates([row._replace(variance=row.variance + row.mean**2) for row in rows], None, beta)
    if last is None:
        _check_rates(rates, distribution, 0.0 if beta else _MARGIN)
    elif distribution is not None and distribution.survival(last) == 0.0:
        raise ValueError(f"distribution ends before level {last}, whose differences are not 0")
    cost = sum(level.cost for level in levels)
    if method == "coupled" and distribution is None:
        cost += ladder_cost(sampler, len(rows) - 1) * _SAMPLES
    return Plan(distribution or _best(sampler, method, rows, rates, last, seed), rates, cost)


def ladder_cost(sampler: Any, level: int) -> float:
    """Cost of one simulation on all levels up to this one, from the costs of pairs of neighbors."""
    return float(sum(sampler.cost(fine) for fine in range(level, -1, -2)))


def _check_rates(rates: Rates, distribution: LevelDistribution | None, margin: float) -> None:
    measured = f"second moments of differences fall as 2^(-{rates.beta:.2f} l), costs grow as 2^({rates.gamma:.2f} l)"
    if rates.beta <= rates.gamma + margin:
        raise ValueError(
            f"variance and cost of an unbiased sum cannot both be finite: {measured}; beta > gamma is needed"
            + (f", by {margin} as both are measured" if margin else "")
        )
    if distribution is None:
        return
    if distribution.ratio == 0.0:
        raise ValueError("distribution has a last level, but the hierarchy has none: the sum would be biased")
    for wrong, what in ((distribution.rate >= rates.beta, "variance"), (distribution.rate <= rates.gamma, "cost")):
        if wrong:
            raise ValueError(
                f"the {what} of an unbiased sum would be infinite: {measured}, and P(N >= l) falls as "
                f"2^(-{distribution.rate:.2f} l), which must lie between"
            )


def _best(
    sampler: Any, method: str, rows: list[LevelRow], rates: Rates, last: int | None, seed: int
) -> LevelDistribution:
    """The distribution that minimizes variance times cost."""
    count = len(rows) if last is None else last + 1
    tail = 0.5 * (rates.beta + rates.gamma) if last is None else 0.0
    means = _extended([row.mean for row in rows], rates.alpha, count)
    costs = _extended([row.cost for row in rows], -rates.gamma, count)
    beyond = means[-1] / (2.0**rates.alpha - 1.0) if last is None else 0.0
    if method == "single":
        squares = _extended([row.variance + row.mean**2 for row in rows], rates.beta, count)
        return best_for_single_term(squares, costs, means.sum() + beyond, tail)
    if method == "independent":
        variances = _extended([row.variance for row in rows], rates.beta, count)
        rest = np.append(means[::-1].cumsum()[::-1], 0.0) + beyond  # E Y - E Y_(l-1)
        rest[0] = 0.0  # the squared mean, taken from the first term
        return best_for_sum(variances + rest[:-1] ** 2 - rest[1:] ** 2, costs, tail)
    finest = len(rows) - 1
    u = level_points(None, sampler.dims(finest), (finest, finest), seed).points(0, _SAMPLES)
    ladder = np.asarray(sampler.ladder(finest, u), np.float64)
    gaps = ((ladder - ladder[:, -1:]) ** 2).mean(axis=0)  # ‖Y_l - Y‖², with Y_finest for Y
    terms = np.append(ladder[:, -1].var(), gaps[:-1]) - gaps
    terms[-1] = min(terms[-1], terms[-2] * 2.0**-rates.beta) if last is None and finest > 0 else terms[-1]
    steps = np.diff([0.0, *(ladder_cost(sampler, level) for level in range(count))])
    return best_for_sum(_extended(terms, rates.beta, count), steps, tail)


def _extended(values: Any, rate: float, count: int) -> Array:
    """Values of all levels, of which those beyond the last one known fall as 2^(-rate l)."""
    known = np.asarray(values, np.float64)
    return np.append(known, known[-1] * 2.0 ** (-rate * np.arange(1, count - len(known) + 1)))
