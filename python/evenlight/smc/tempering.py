"""Tempering: from prior to posterior through powers of the likelihood. For normalizing constants and several modes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, SupportsIndex

import numpy as np
from scipy import optimize

from evenlight.arguments import SeedLike, integer, seed_number
from evenlight.moments import Moments
from evenlight.points import Independent
from evenlight.smc.log_evidence import LogEvidence, log_evidence
from evenlight.smc.numbers import StepNumbers
from evenlight.smc.random_walk import TemperedStates, rescaled, shape_of, step
from evenlight.smc.resampling import RESAMPLING
from evenlight.smc.state_space import Array
from evenlight.smc.weights import effective_size, normalized

__all__ = ["temper"]


def temper(
    prior: Any,
    log_likelihood: Callable[[Array], Any],
    *,
    particles: SupportsIndex = 1024,
    moves: SupportsIndex = 20,
    waste_free: bool = True,
    effective: float = 0.5,
    temperatures: Any = None,
    resampling: str = "systematic",
    function: Callable[[Array], Any] | None = None,
    replicates: SupportsIndex = 8,
    seed: SeedLike = None,
) -> LogEvidence:
    """Estimate the mean of a likelihood under a prior, and means under the posterior.

    Parameters
    ----------
    prior : object
        With `d`, `uniforms`, ``sample(u)`` and ``logpdf(x)``: one of `evenlight.importance`, such as `Normal`.
    log_likelihood : callable
        From points, shape (n, d), to logarithms, shape (n,); -inf where the likelihood is 0.
    particles : int
        In each replicate. With `waste_free`, a multiple of ``moves + 1``, or it is rounded up to one.
    moves : int
        Steps of random-walk Metropolis at every temperature, at least 1.
    waste_free : bool
        Keep the states of all moves as particles: few chains, ``particles / (moves + 1)``, are moved. Otherwise all
        particles are moved and only their last states are kept, ``moves`` times the cost.
    effective : float
        The next temperature is where the weights are worth this share of the particles, between 0 and 1.
    temperatures : sequence of float, optional
        Ascending from above 0 to 1: powers of the likelihood, in place of those found on the way.
    resampling : {"systematic", "stratified", "residual", "multinomial"}
        How particles are selected by their weights.
    function : callable, optional
        From points, shape (n, d), to what is averaged under the posterior, shape (n,) or (n, k); the points by default.
    replicates : int
        Independent runs, whose spread is the error; at least 1 (without an error).
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    Returns
    -------
    LogEvidence
        The logarithm of the normalizing constant Z. Temperatures and step sizes are learned from the particles
        themselves, so that Z is not exactly unbiased; the bias is of order 1 / particles and vanishes besides the
        error. Diagnostics: "replicates" (log Z of each), "means" and "standard_errors" (under the posterior),
        "temperatures" and "acceptance" (of the last replicate).

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above, a likelihood is NaN or +inf, or is 0 everywhere.

    Notes
    -----
    Cost: ``particles`` likelihoods per temperature with `waste_free`, else ``particles * moves``. Proposals have the
    particles' covariance, scaled after each temperature so that about 23 % are accepted.

    References: P. Del Moral, A. Doucet and A. Jasra, "Sequential Monte Carlo samplers", J. R. Stat. Soc. B 68(3),
    411-436 (2006); A. Jasra, D. A. Stephens, A. Doucet and T. Tsagaris, Scand. J. Stat. 38(1), 1-22 (2011)
    (temperatures); H.-D. Dau and N. Chopin, "Waste-free sequential Monte Carlo", J. R. Stat. Soc. B 84(1), 114-148
    (2022).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import smc
    >>> from evenlight.importance import Normal
    >>> likelihood = Normal([1.0, -1.0], 0.01)
    >>> evidence = smc.temper(Normal([0.0, 0.0]), likelihood.logpdf, particles=2016, seed=1)
    >>> truth = Normal([0.0, 0.0], 1.01).logpdf(np.array([[1.0, -1.0]]))[0]
    >>> bool(abs(evidence.value - truth) < 4 * evidence.standard_error < 0.2)
    True
    """
    number, steps = integer("particles", particles, 2), integer("moves", moves, 1)
    run = _Run(
        prior,
        _Target(prior, log_likelihood),
        chains=-(-number // (steps + 1)) if waste_free else number,
        moves=steps,
        waste_free=bool(waste_free),
        effective=_share("effective", effective),
        temperatures=_schedule(temperatures),
        resampling=_known(resampling),
        seed=seed_number(seed),
    )
    results = [run.replicate(r) for r in range(integer("replicates", replicates, 1))]
    of_points = (lambda x: x) if function is None else function
    moments = Moments.of(np.array([np.mean(np.asarray(of_points(r.x), np.float64), axis=0) for r in results]))
    return log_evidence(
        [result.log_z for result in results],
        n=len(results) * run.size,
        cost=sum(result.cost for result in results),
        method="tempering",
        points=(f"tempering of seed {run.seed}",),
        means=moments.mean,
        standard_errors=moments.standard_error,
        temperatures=results[-1].temperatures,
        acceptance=results[-1].acceptance,
    )


class _Result(NamedTuple):
    log_z: float
    x: Array
    """Points of the posterior, all of the same weight."""
    cost: float
    temperatures: list[float]
    acceptance: list[float]


class _Target:
    """Prior and likelihood at points, checked."""

    def __init__(self, prior: Any, log_likelihood: Callable[[Array], Any]) -> None:
        if not all(hasattr(prior, name) for name in ("d", "uniforms", "sample", "logpdf")):
            raise TypeError(f"prior must have d, uniforms, sample and logpdf, which {type(prior).__name__} has not")
        self._prior, self._log_likelihood = prior, log_likelihood

    def __call__(self, x: Array) -> TemperedStates:
        values = np.asarray(self._log_likelihood(x), np.float64)
        if values.shape != (len(x),):
            raise ValueError(f"log_likelihood must return shape ({len(x)},), not {values.shape}")
        wrong = np.isnan(values) | (values == np.inf)
        if wrong.any():
            raise ValueError(f"log_likelihood is {values[wrong][0]} at {x[wrong][0]}")
        return TemperedStates(x, np.asarray(self._prior.logpdf(x), np.float64), values)


@dataclass(frozen=True)
class _Run:
    """The settings of a run; `replicate` runs it."""

    prior: Any
    target: _Target
    chains: int
    moves: int
    waste_free: bool
    effective: float
    temperatures: list[float] | None
    resampling: str
    seed: int

    @property
    def size(self) -> int:
        """The number of particles."""
        return self.chains * (self.moves + 1) if self.waste_free else self.chains

    def replicate(self, r: int) -> _Result:
        """From the prior to the posterior."""
        d = int(self.prior.d)
        start = StepNumbers(Independent(1), self.size, 1, self.seed, r).start(int(self.prior.uniforms))
        numbers = StepNumbers(Independent(1), self.chains, 1 + self.moves * (d + 1), self.seed, r)
        states = self.target(np.asarray(self.prior.sample(start), np.float64))
        log_z, reached, cost, scale = 0.0, 0.0, float(self.size), 1.0
        path: list[float] = []
        acceptance: list[float] = []
        while reached < 1.0:
            following = self._next(states.log_likelihood, reached, len(path))
            log_weights = _powers(states.log_likelihood, following - reached)
            weights, increment = normalized(log_weights, f"temperature {following:.3g}")
            u = numbers.step(len(path))
            root = scale * shape_of(states.x, weights)
            chosen = RESAMPLING[self.resampling](weights, u[:, 0], self.chains)
            states, accepted = self._move(states.take(chosen), following, root, u[:, 1:])
            scale = rescaled(scale, accepted)
            log_z, reached, cost = log_z + increment, following, cost + self.chains * self.moves
            path.append(following)
            acceptance.append(accepted)
        return _Result(log_z, states.x, cost, path, acceptance)

    def _move(self, states: TemperedStates, temperature: float, root: Array, u: Array) -> tuple[TemperedStates, float]:
        """The particles of the next temperature, and the mean share of accepted proposals."""
        kept, shares = [states], []
        for numbers in np.split(u, self.moves, axis=1):
            states, share = step(states, self.target, temperature, root, numbers)
            kept.append(states)
            shares.append(share)
        if self.waste_free:
            states = TemperedStates(*(np.concatenate(parts) for parts in zip(*kept, strict=True)))
        return states, float(np.mean(shares))

    def _next(self, log_likelihood: Array, reached: float, number: int) -> float:
        """The power of the likelihood at which weights are worth the wanted share of particles that are possible."""
        if self.temperatures is not None:
            return self.temperatures[number]
        wanted = self.effective * float(np.isfinite(log_likelihood).sum())

        def surplus(rise: float) -> float:
            weights, _ = normalized(_powers(log_likelihood, rise), f"temperature {reached + rise:.3g}")
            return effective_size(weights) - wanted

        rest = 1.0 - reached
        if surplus(rest) >= 0:
            return 1.0
        return reached + max(float(optimize.bisect(surplus, 0.0, rest, xtol=1e-12 * rest, rtol=1e-6)), 1e-12 * rest)


def _powers(log_likelihood: Array, rise: float) -> Array:
    """Logarithms of weights; those of impossible points are -inf even for no rise at all."""
    possible = np.isfinite(log_likelihood)
    return np.where(possible, rise * np.where(possible, log_likelihood, 0.0), -np.inf)


def _share(name: str, value: float) -> float:
    if not 0.0 < value < 1.0:
        raise ValueError(f"{name} must be between 0 and 1, not {value}")
    return float(value)


def _known(resampling: str) -> str:
    if resampling not in RESAMPLING:
        raise ValueError(f"unknown resampling {resampling!r}; known: {', '.join(RESAMPLING)}")
    return resampling


def _schedule(temperatures: Any) -> list[float] | None:
    if temperatures is None:
        return None
    numbers = [float(number) for number in temperatures]
    if not numbers or numbers[-1] != 1.0 or (np.diff([0.0, *numbers]) <= 0).any():
        raise ValueError(f"temperatures must ascend from above 0 to 1, not {numbers}")
    return numbers
