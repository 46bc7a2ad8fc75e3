"""Ladders of temperatures: how hard they are to climb, how evenly their steps are, and better ones."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from .chains import Chains
from .kernel import Array

__all__ = ["Ladder", "rejections", "respaced", "tempering_ladder"]

_LEAST = 1e-3  # a rejection rate, so that no two temperatures fall together


@dataclass(frozen=True, eq=False)
class Ladder:
    """What a run of `ParallelTempering` says of its temperatures [1]_.

    References
    ----------
    .. [1] S. Syed, A. Bouchard-Côté, G. Deligiannidis and A. Doucet, "Non-reversible parallel tempering", J. R. Stat.
       Soc. B 84(2), 321-350 (2022).

    Examples
    --------
    >>> from evenlight.mcmc import Ladder
    >>> ladder = Ladder([1.0, 0.3, 0.1], rejections=[0.4, 0.6], round_trips=80, steps=600)
    >>> ladder.barrier, ladder.suggested_levels, round(ladder.best_round_trip_rate, 3)
    (1.0, 3, 0.158)
    """

    inverse_temperatures: Array
    """From 1 down."""
    rejections: Array
    """The rate at which swaps of neighbors are rejected, one for each pair."""
    round_trips: int
    """How often a position went from the coldest to the hottest temperature and back, in all chains."""
    steps: int
    """Of all chains."""

    @property
    def barrier(self) -> float:
        """The sum of the rejections: with many levels, a number of target and kernel that no spacing changes."""
        return float(np.sum(self.rejections))

    @property
    def suggested_levels(self) -> int:
        """One more than twice the barrier: then half of the swaps are rejected, which is most efficient."""
        return max(2, 1 + math.ceil(2 * self.barrier))

    @property
    def round_trip_rate(self) -> float:
        """Round trips for each step."""
        return self.round_trips / self.steps

    @property
    def best_round_trip_rate(self) -> float:
        """Round trips for each step if kernels forgot where they were: the measured rate is below where they do not."""
        rejected = np.asarray(self.rejections, np.float64)
        return float(1 / (2 + 2 * (rejected / (1 - rejected)).sum()))


def tempering_ladder(chains: Chains) -> Ladder:
    """How the temperatures of a run have done.

    Parameters
    ----------
    chains : Chains
        Of `ParallelTempering`, of at least 2 steps.

    Returns
    -------
    Ladder
        Rejections, barrier, round trips, how many levels there should be.

    Raises
    ------
    ValueError
        If the chains are of another kernel, or of one step.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import ParallelTempering, RandomWalk, run, tempering_ladder
    >>> modes = lambda x: np.logaddexp(-0.5 * (x[:, 0] - 10) ** 2, -0.5 * (x[:, 0] + 10) ** 2)
    >>> kernel = ParallelTempering(modes, lambda f, beta: RandomWalk(f, scale=2 / beta**0.5), levels=5, hottest=0.01)
    >>> ladder = tempering_ladder(run(kernel, [10.0], n=1000, chains=16, warm_up=800, seed=1))
    >>> bool(np.ptp(ladder.rejections) < 0.1), ladder.suggested_levels
    (True, 4)
    """
    if "swaps" not in chains.info or chains.n < 2:
        raise ValueError("a ladder is judged by chains of ParallelTempering, of at least 2 steps")
    betas = np.asarray(chains.kernel.inverse_temperatures, np.float64)
    trips = chains.info["round_trips"]
    return Ladder(betas, rejections(chains.info["swaps"]), int(trips.sum()), trips.size)


def rejections(swaps: Array) -> Array:
    """Mean rates from probabilities of swaps (chains, steps, pairs), NaN where it was not a pair's turn."""
    return np.asarray(1 - np.nanmean(swaps, axis=(0, 1)))


def respaced(inverse_temperatures: Array, rejected: Array) -> Array:
    """As many temperatures, with the same ends, whose neighbors would reject the same part of their swaps.

    Rejections add up to the barrier as a function of temperature; between the temperatures, monotone cubic
    interpolation tells where it has its evenly spaced values.
    """
    barrier = np.concatenate([[0.0], np.cumsum(np.maximum(rejected, _LEAST))])
    even = np.linspace(0, barrier[-1], len(barrier))[1:-1]
    inner = np.exp(PchipInterpolator(barrier, np.log(inverse_temperatures))(even))
    return np.concatenate([inverse_temperatures[:1], inner, inverse_temperatures[-1:]])
