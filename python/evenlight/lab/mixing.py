"""Mixing: random walks take the square of the distance, momentum takes the distance; far modes, and tempering them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import SeedLike, integer
from evenlight.estimate import Estimate
from evenlight.mcmc import HMC, ParallelTempering, RandomWalk, run

__all__ = ["LESSONS", "FarModes", "MixingLesson", "crossing_time", "far_modes", "mixing_lesson", "mixing_steps"]

Array = NDArray[np.float64]


class MixingLesson(NamedTuple):
    """What it costs to forget the start, at doubling sizes N, and the power of N that it follows."""

    sizes: Array
    """N: numbers of states, or the length over the width of a normal target."""
    costs: Array
    """Steps to mix, or evaluations of density or gradient for each independent draw."""
    exponent: float
    """The slope of log cost in log N, by least squares."""
    claimed: float
    """2 for walks, 1 with momentum."""
    tolerance: float
    """How far the exponents may be apart: sizes are finite, and some costs are measured."""

    @property
    def holds(self) -> bool:
        """Whether the measured exponent is the claimed one, within the tolerance."""
        return abs(self.exponent - self.claimed) <= self.tolerance


class FarModes(NamedTuple):
    """The weight of one of two far modes by three runs; its truth is 1/4."""

    alone: Estimate
    """Random walks that all start in that mode: 1, with no error at all."""
    spread: Estimate
    """Random walks of which half start in each mode: 1/2, whatever the weight is."""
    tempered: Estimate
    """Parallel tempering that starts in that mode."""
    r_hat: tuple[float, float, float]
    """R-hat of the three runs: the first sees nothing, the second sees it, the third is fine."""

    @property
    def holds(self) -> bool:
        """Whether the walks fail as described, and tempering is right within 4 standard errors of at most 5 %."""
        error = self.tempered.standard_error
        fails = self.alone.value == 1 and self.spread.value == 0.5
        seen = self.r_hat[0] < 1.05 < 1.5 < self.r_hat[1] and self.r_hat[2] < 1.05
        return bool(fails and seen and abs(self.tempered.value - 0.25) < 4 * error and error < 0.05)


def crossing_time(n: int) -> float:
    """The expected steps of a walk on {0, ..., n}, reflected at 0, from 0 to n: exactly n^2, here by linear equations.

    Parameters
    ----------
    n : int
        At least 1.

    Returns
    -------
    float
        From the equations h(0) = 1 + h(1), h(i) = 1 + (h(i - 1) + h(i + 1)) / 2, h(n) = 0.

    Examples
    --------
    >>> from evenlight.lab import crossing_time
    >>> round(crossing_time(20), 6)
    400.0
    """
    size = integer("n", n, 1)
    matrix = np.eye(size)
    for state in range(size):
        for neighbor in (1, 1) if state == 0 else (state - 1, state + 1):
            if neighbor < size:
                matrix[state, neighbor] -= 0.5
    return float(np.linalg.solve(matrix, np.ones(size))[0])


def mixing_steps(n: int, lifted: bool = False) -> int:
    """The steps after which a walk on a cycle of n states is within total variation 1/4 of uniform; exact laws.

    Parameters
    ----------
    n : int
        An even number of states, at least 4.
    lifted : bool
        False: the lazy walk, which stays with probability 1/2 and otherwise moves to a neighbor. True: the walk that
        keeps its direction with probability 1 - 1/n, and reverses it otherwise, before it moves [1]_; as it changes
        parity at every step, the average of two successive laws counts.

    Returns
    -------
    int
        The first such number of steps.

    References
    ----------
    .. [1] P. Diaconis, S. Holmes and R. M. Neal, "Analysis of a nonreversible Markov chain sampler", Ann. Appl. Probab.
       10(3), 726-752 (2000).

    Examples
    --------
    >>> from evenlight.lab import mixing_steps
    >>> [mixing_steps(n) for n in (16, 32, 64)], [mixing_steps(n, lifted=True) for n in (16, 32, 64)]
    ([25, 98, 389], [19, 40, 84])
    """
    size = integer("n", n, 4)
    if size % 2:
        raise ValueError(f"n must be even, not {size}")
    law = np.zeros((2, size))  # by direction
    law[:, 0] = 0.5
    before, steps = law.sum(axis=0), 0
    while True:
        law = _lifted(law, 1 / size) if lifted else _lazy(law)
        steps += 1
        now = law.sum(axis=0)
        counted = 0.5 * (now + before) if lifted else now
        if 0.5 * np.abs(counted - 1 / size).sum() < 0.25:
            return steps
        before = now


def _lazy(law: Array) -> Array:
    return 0.5 * law + 0.25 * (np.roll(law, 1, axis=1) + np.roll(law, -1, axis=1))


def _lifted(law: Array, reversal: float) -> Array:
    turned = (1 - reversal) * law + reversal * law[::-1]
    return np.stack([np.roll(turned[0], 1), np.roll(turned[1], -1)])


def _elongated(n: float) -> tuple[Callable[[Any], Any], Callable[[Any], Any], Array]:
    """A normal with standard deviations 1 and n: log density, gradient, and 64 exact draws to start from."""
    deviations = np.array([1.0, n])
    start = np.random.default_rng(1).normal(size=(64, 2)) * deviations
    return lambda x: -0.5 * ((x / deviations) ** 2).sum(axis=1), lambda x: -x / deviations**2, start


def _walk_cost(n: int) -> float:
    """Densities for each independent draw along an elongated normal, by a random walk of the width's scale."""
    log_density, _, start = _elongated(n)
    chains = run(RandomWalk(log_density, scale=1.5), start, n=40 * n * n, seed=2)
    return 64 * chains.n / float(chains.diagnostics().ess_bulk[1])


def _hmc_cost(n: int) -> float:
    """Gradients for each independent draw along it, by HMC of the length's duration."""
    log_density, gradient, start = _elongated(n)
    chains = run(HMC(log_density, gradient, step_size=1.0, steps=3 * n), start, n=400, seed=2)
    return float(chains.info["gradients"].sum() / chains.diagnostics().ess_bulk[1])


LESSONS: dict[str, tuple[Callable[[int], float], float, float, tuple[int, ...]]] = {
    "crossing": (crossing_time, 2.0, 0.001, (4, 8, 16, 32, 64)),
    "walk": (mixing_steps, 2.0, 0.02, (16, 32, 64, 128)),
    "lifted": (lambda n: mixing_steps(n, lifted=True), 1.0, 0.15, (16, 32, 64, 128, 256)),
    "metropolis": (_walk_cost, 2.0, 0.3, (4, 8, 16)),
    "hmc": (_hmc_cost, 1.0, 0.3, (4, 8, 16, 32)),
}
"""What a lesson measures, the exponent that is claimed, its tolerance, and sizes."""


def mixing_lesson(name: str, sizes: Sequence[int] | None = None) -> MixingLesson:
    """Measure how the cost of forgetting the start grows with the size.

    Parameters
    ----------
    name : {"crossing", "walk", "lifted", "metropolis", "hmc"}
        "crossing": `crossing_time`. "walk", "lifted": `mixing_steps`. "metropolis", "hmc": evaluations for each
        independent draw along a normal target n times as long as wide, by effective sample sizes of 64 chains.
    sizes : sequence of int, optional
        Increasing; some doublings by default.

    Returns
    -------
    MixingLesson
        Costs, their exponent, and whether it is the one that is claimed.

    Raises
    ------
    ValueError
        If there is no such lesson, or fewer than two sizes.

    Examples
    --------
    >>> from evenlight.lab import mixing_lesson
    >>> walk, lifted = mixing_lesson("walk"), mixing_lesson("lifted")
    >>> round(walk.exponent, 1), round(lifted.exponent, 1), walk.holds and lifted.holds
    (2.0, 1.1, True)
    """
    if name not in LESSONS:
        raise ValueError(f"unknown lesson {name!r}; known: {', '.join(LESSONS)}")
    cost, claimed, tolerance, usual = LESSONS[name]
    chosen = usual if sizes is None else tuple(sizes)
    if len(chosen) < 2:
        raise ValueError(f"an exponent needs at least 2 sizes, not {len(chosen)}")
    costs = np.array([cost(n) for n in chosen], np.float64)
    exponent = float(np.polyfit(np.log(chosen), np.log(costs), 1)[0])
    return MixingLesson(np.array(chosen, np.float64), costs, exponent, claimed, tolerance)


def far_modes(*, distance: float = 16.0, n: int = 2000, chains: int = 32, seed: SeedLike = 1) -> FarModes:
    """Two normal modes of weights 1/4 and 3/4: random walks that fail, one of them without a sign, and tempering.

    Parameters
    ----------
    distance : float
        Between the modes, in their standard deviations, at least 4; from about 10 on, walks do not cross.
    n : int
        Steps that count.
    chains : int
        An even number of chains.
    seed : int or numpy.random.Generator, optional
        Of all runs.

    Returns
    -------
    FarModes
        Estimates of the weight of the first mode, R-hat, and whether all is as claimed.

    Raises
    ------
    ValueError
        If the modes are no modes, or there are fewer than 2 chains.

    Examples
    --------
    >>> from evenlight.lab import far_modes
    >>> lesson = far_modes()
    >>> lesson.alone.value, lesson.spread.value, round(lesson.tempered.value, 2), lesson.holds
    (1.0, 0.5, 0.25, True)
    """
    if not 4 <= distance < np.inf:
        raise ValueError(f"distance must be at least 4, not {distance}")
    half = 0.5 * distance

    def log_density(x: Any) -> Any:
        at = x[:, 0]
        return np.logaddexp(-0.5 * (at + half) ** 2, np.log(3.0) - 0.5 * (at - half) ** 2)

    def kernel(tempered: Callable[[Any], Any], beta: float) -> RandomWalk:
        return RandomWalk(tempered, scale=2.4 / beta**0.5)

    first = np.full((integer("chains", chains, 2), 1), -half)
    both = np.where(np.arange(len(first))[:, None] % 2, half, -half)
    ladder = 4.0 ** -np.arange(0, np.log2(half) + 0.5, 0.5)
    runs = [
        run(kernel(log_density, 1.0), first, n=n, seed=seed),
        run(kernel(log_density, 1.0), both, n=n, seed=seed),
        run(ParallelTempering(log_density, kernel, ladder.tolist()), first, n=n, burn_in=500, seed=seed),
    ]
    alone, spread, tempered = (each.estimate(lambda x: x[:, 0] < 0) for each in runs)
    r_hat = [float(each.diagnostics().r_hat[0]) for each in runs]
    return FarModes(alone, spread, tempered, (r_hat[0], r_hat[1], r_hat[2]))
